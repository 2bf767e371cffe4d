#include "core/pack/loader.h"

#include <gtest/gtest.h>

#include <limits>
#include <memory>

#include "tests/unit/core/pack/tiny_pack.h"

namespace caryatid::pack {
namespace {

struct Loaded {
  std::unique_ptr<Loader> loader = std::make_unique<Loader>();
  std::vector<Vec4> memory;
  Status status;
};

Loaded load(std::span<const std::byte> file, std::size_t piece = 1000000, bool end = true) {
  Loaded out;
  const Result<PackHeader> header = read_header(file);
  out.status = header.status;
  if (!header.ok()) return out;
  out.memory.resize(header.value.image_bytes / sizeof(Vec4) + 1);
  out.status = out.loader->begin(header.value, std::as_writable_bytes(std::span(out.memory)));
  for (std::size_t at = sizeof(PackHeader); at < file.size() && out.status.ok(); at += piece)
    out.status = out.loader->feed(file.subspan(at, std::min(piece, file.size() - at)));
  if (out.status.ok() && end) out.status = out.loader->end();
  return out;
}

Refusal refusal(const Loaded& loaded) { return static_cast<Refusal>(loaded.status.detail); }

TEST(Loader, TakesAWholePackInPiecesOfAnySize) {
  const auto file = TinyPack().file();
  for (const std::size_t piece : {1u, 7u, 64u, 100000u}) {
    const Loaded loaded = load(file, piece);
    ASSERT_TRUE(loaded.status.ok());
    EXPECT_TRUE(loaded.loader->complete());
    EXPECT_STREQ(loaded.loader->view().objects[0].name, "skin");
    EXPECT_EQ(find_object(loaded.loader->view(), "skin"), 0);
    EXPECT_NE(find_feature_point(loaded.loader->view(), 2, 1), nullptr);
    EXPECT_EQ(find_feature_point(loaded.loader->view(), 9, 9), nullptr);
  }
}

TEST(Loader, BasePartIsUsableBeforeTheRest) {
  const auto file = TinyPack().file();
  const Loaded loaded = load(std::span(file).first(file.size() - 4), 100000, false);
  EXPECT_TRUE(loaded.status.ok());
  EXPECT_TRUE(loaded.loader->base_ready());
  EXPECT_FALSE(loaded.loader->complete());
  EXPECT_FALSE(loaded.loader->texture_complete(0));
}

TEST(Loader, EveryCutIsRefused) {
  const auto file = TinyPack().file();
  for (std::size_t n = 0; n < file.size(); ++n)
    EXPECT_FALSE(load(std::span(file).first(n)).status.ok()) << n;
}

TEST(Loader, EveryFlippedBitIsRefused) {
  auto file = TinyPack().file();
  for (std::size_t byte = 0; byte < file.size(); ++byte)
    for (int bit = 0; bit < 8; ++bit) {
      file[byte] ^= static_cast<std::byte>(1 << bit);
      EXPECT_FALSE(load(file).status.ok()) << "byte " << byte << " bit " << bit;
      file[byte] ^= static_cast<std::byte>(1 << bit);
    }
}

TEST(Loader, DamagedRefinementKeepsTheBase) {
  auto file = TinyPack().file();
  file.back() ^= std::byte{1};
  const Loaded loaded = load(file);
  EXPECT_EQ(refusal(loaded), Refusal::chunk_crc);
  EXPECT_TRUE(loaded.loader->base_ready());
}

TEST(Loader, RefusesAnotherVersionByName) {
  auto file = TinyPack().file();
  file[8] = std::byte{99};
  auto* h = reinterpret_cast<PackHeader*>(file.data());
  h->header_crc = crc32c(std::span(file).first(60));
  EXPECT_EQ(load(file).status.code, Code::unsupported);
}

TEST(Loader, RefusesAPackLargerThanItsMemory) {
  const auto file = TinyPack().file();
  alignas(16) std::byte small[64];
  Loader loader;
  EXPECT_EQ(loader.begin(read_header(file).value, small).code, Code::out_of_capacity);
}

// Each hostile content, well sealed by its CRC, has its own refusal.
template <class T, class Change>
Refusal refusal_after(SectionId section, Change change) {
  TinyPack pack;
  change(pack.edit<T>(section));
  return refusal(load(pack.file()));
}

TEST(Loader, HostileContentHasItsOwnRefusal) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(refusal_after<Joint>(SectionId::joints, [](Joint* j) { j->parent = 0; }),
            Refusal::bad_joint);
  EXPECT_EQ(refusal_after<Material>(SectionId::materials, [](Material* m) { m->texture = 7; }),
            Refusal::bad_material);
  EXPECT_EQ(refusal_after<Texture>(SectionId::textures, [](Texture* t) { t->width = 3; }),
            Refusal::bad_texture);
  EXPECT_EQ(refusal_after<Texture>(SectionId::textures, [](Texture* t) { t->texel_bytes = 8; }),
            Refusal::bad_texture);
  EXPECT_EQ(refusal_after<Object>(SectionId::objects, [](Object* o) { o->bone[0] = 5; }),
            Refusal::bad_object);
  EXPECT_EQ(refusal_after<Object>(SectionId::objects, [](Object* o) { o->version_count = 9; }),
            Refusal::bad_object);
  EXPECT_EQ(refusal_after<Object>(SectionId::objects,
                                  [](Object* o) {
                                    o->base_triangle_count = 0x80000001u;
                                    o->max_triangle_count = ~0u;
                                  }),
            Refusal::bad_object);
  EXPECT_EQ(
      refusal_after<std::uint16_t>(SectionId::base_indices, [](std::uint16_t* i) { i[2] = 3; }),
      Refusal::bad_index);
  EXPECT_EQ(refusal_after<Vertex>(SectionId::versions, [](Vertex* v) { v->position_m[0] = nan; }),
            Refusal::bad_number);
  EXPECT_EQ(refusal_after<Channel>(SectionId::channels, [](Channel* c) { c->to = c->from; }),
            Refusal::bad_channel);
  EXPECT_EQ(refusal_after<std::uint32_t>(SectionId::fat_first, [](std::uint32_t* f) { f[1] = 2; }),
            Refusal::bad_move);
  EXPECT_EQ(refusal_after<Move>(SectionId::fat_moves, [](Move* m) { m->channel = 1; }),
            Refusal::bad_move);
  for (const auto& spoil : std::initializer_list<void (*)(FitRule*)>{
           [](FitRule* r) { r->receiver = 2; }, [](FitRule* r) { r->receiver = 69; },
           [](FitRule* r) { r->receiver = 6; }, [](FitRule* r) { r->numerator_count = 0; },
           [](FitRule* r) { r->numerator_count = kFitNumerators + 1; },
           [](FitRule* r) { r->denominator_count = kFitDenominators + 1; },
           [](FitRule* r) { r->numerator[0].fap[0] = 0; },
           [](FitRule* r) { r->numerator[0].fap[1] = 200; },
           [](FitRule* r) { r->numerator[0].power[0] = 4; },
           [](FitRule* r) { r->numerator[0].coefficient = nan; },
           [](FitRule* r) { r->denominator_count = 1, r->denominator[0].fap[0] = 7; }})
    EXPECT_EQ(refusal_after<FitRule>(SectionId::fit, spoil), Refusal::bad_fit);
  EXPECT_EQ(refusal_after<FeaturePoint>(SectionId::feature_points,
                                        [](FeaturePoint* p) { p->vertex = 3; }),
            Refusal::bad_feature_point);
  EXPECT_EQ(refusal_after<float>(SectionId::rest_face, [](float* r) { r[3] = nan; }),
            Refusal::bad_number);
  EXPECT_EQ(
      refusal_after<Character>(SectionId::character, [](Character* c) { c->mouth_width_m = 0; }),
      Refusal::bad_number);
}

// Found by the fuzzer: what was checked must not change afterwards.
TEST(Loader, OverlappingSectionsAreRefused) {
  auto file = TinyPack().file();
  auto* header = reinterpret_cast<PackHeader*>(file.data());
  auto* sections = reinterpret_cast<Section*>(file.data() + sizeof(PackHeader));
  sections[5].offset = sections[6].offset;
  const std::size_t tables =
      header->section_count * sizeof(Section) + header->chunk_count * sizeof(Chunk);
  header->tables_crc = crc32c(std::span(file).subspan(sizeof(PackHeader), tables));
  header->header_crc = crc32c(std::span(file).first(60));
  EXPECT_EQ(refusal(load(file)), Refusal::table_ranges);
}

TEST(Loader, InterpolationRulesMayBeMissing) {
  TinyPack with, without;
  without.drop(SectionId::fit);
  EXPECT_TRUE(load(with.file()).status.ok());
  EXPECT_TRUE(load(without.file()).status.ok());
}

TEST(Loader, EverySectionIsNeeded) {
  for (const SectionId id : {SectionId::character, SectionId::joints, SectionId::materials,
                             SectionId::objects, SectionId::fat_first, SectionId::rest_face}) {
    TinyPack pack;
    pack.drop(id);
    EXPECT_FALSE(load(pack.file()).status.ok());
  }
}

}  // namespace
}  // namespace caryatid::pack
