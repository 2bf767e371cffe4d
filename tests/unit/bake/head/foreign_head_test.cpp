// Foreign heads: a coarse head of our own, written as another program might, and, where they are
// there, heads of others.
#include "assets/bake/head/foreign_head.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <memory>
#include <span>

#include "assets/bake/face/fat.h"
#include "assets/bake/face/movement.h"
#include "assets/bake/human/build.h"
#include "assets/bake/mesh_io/mesh_io.h"
#include "assets/bake/pack/writer.h"
#include "core/agent/person.h"
#include "core/emotion/profiles.h"
#include "core/face/fap_fill.h"
#include "core/face/fap_table.h"
#include "core/face/fat.h"
#include "core/face/mixer.h"
#include "core/stream/fap_text.h"
#include "tests/support/test_data.h"

namespace caryatid::bake::foreign {
namespace {

using face::FapFrame;

const std::string kHeads = CARYATID_SOURCE_DIR "/tests/data/heads/";
const std::string kCharacters = CARYATID_SOURCE_DIR "/assets/characters/";

fat::WorkingRanges ranges() {
  return fat::read_working_ranges(kCharacters + "fap_working_ranges.csv");
}

PointList points_of(const std::string& stem) {
  const std::string file = kHeads + stem + ".points";
  return parse_points(read_file(file), file);
}

ForeignHead build(const std::filesystem::path& obj, const std::string& stem) {
  return build_foreign_head(read_mesh(obj), points_of(stem), stem, ranges());
}

// How a face moves, at its feature points.
struct Face {
  Character character;
  fat::Head head;

  Vec3 displacement(const FapFrame& frame, int group, int index) const {
    std::vector<float> weight(character.channels.size());
    EXPECT_TRUE(face::evaluate_channels(character.channels, frame, weight).ok());
    for (const FeaturePoint& p : character.feature_points) {
      if (p.group != group || p.index != index || p.object == kNone) continue;
      Vec3 sum{0};
      for (std::size_t c = 0; c < weight.size(); ++c)
        if (weight[c] != 0.0f)
          for (const Move& m : character.objects[p.object].moves[c])
            if (m.vertex == p.vertex) sum += weight[c] * m.displacement_m;
      return sum;
    }
    ADD_FAILURE() << "no point " << group << "." << index << " on " << character.name;
    return Vec3(0);
  }
};

const Face& coarse() {
  static const Face face = [] {
    ForeignHead f = build(kHeads + "coarse_head.obj", "coarse_head");
    return Face{std::move(f.character), std::move(f.head)};
  }();
  return face;
}

bool is_displacement(int fap) {
  const face::FapInfo& info = face::fap_info(fap);
  return info.unit != face::FapUnit::au && face::direction_vector(info.positive) != Vec3(0) &&
         fap != 27 && fap != 28;  // Eyeballs are shifted as joints.
}

// Every FAP moves its point by its amount in FAPU, as on our own people.
void expect_exact_faps(const Face& face) {
  const fat::WorkingRanges range = ranges();
  for (int fap = 3; fap <= face::kFapCount; ++fap) {
    const face::FapInfo& info = face::fap_info(fap);
    const std::pair<int, int> point{info.point.group, info.point.index};
    if (!is_displacement(fap) || !face.head.point_m.contains(point)) continue;
    const auto i = static_cast<std::size_t>(fap);
    for (const float nominal : {0.5f * range.low[i], 0.5f * range.high[i]}) {
      if (nominal == 0.0f) continue;
      FapFrame frame;
      frame.set(fap, nominal);
      const float moved = glm::dot(face.displacement(frame, point.first, point.second),
                                   face::direction_vector(info.positive)) /
                          fat::metres_per_unit(face.head, fap);
      EXPECT_NEAR(moved, nominal, std::max(2.0f, 0.02f * std::abs(nominal)))
          << face.character.name << ": FAP " << fap << " " << info.name;
    }
  }
}

TEST(ForeignHead, EveryFapMovesItsPointByItsAmount) { expect_exact_faps(coarse()); }

// Four triangles for one, on the same facets.
Surface finer(const Surface& s) {
  Surface out{s.position, {}};
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto [found, fresh] =
        middles.emplace(std::minmax(a, b), static_cast<std::uint32_t>(out.position.size()));
    if (fresh) out.position.push_back(0.5 * (s.position[a] + s.position[b]));
    return found->second;
  };
  for (const auto& [a, b, c] : s.triangles) {
    const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    for (const Triangle& t : {Triangle{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}})
      out.triangles.push_back(t);
  }
  return out;
}

TEST(ForeignHead, AFineMeshIsSimplifiedFirstAndMovesAsWell) {
  const Surface fine = finer(finer(finer(read_mesh(kHeads + "coarse_head.obj"))));
  ASSERT_GT(fine.triangles.size(), 100000u);
  ForeignHead f = build_foreign_head(fine, points_of("coarse_head"), "fine", ranges());
  EXPECT_LT(f.character.objects.front().mesh.triangles.size(), 25000u);
  expect_exact_faps({std::move(f.character), std::move(f.head)});
}

TEST(ForeignHead, HeadsOfOthersMoveByTheSameAmounts) {
  CARYATID_NEED_TEST_DATA(heads, "heads");
  for (const char* stem : {"canonical_face_model", "candide3"}) {
    ForeignHead f = build(heads / (std::string(stem) + ".obj"), stem);
    expect_exact_faps({std::move(f.character), std::move(f.head)});
  }
}

// The kiosk's own person, from the bytes of the pack, moves the head's points as the bake meant.
TEST(ForeignHead, ItsPackLoadsAndMoves) {
  ForeignHead f = build(kHeads + "coarse_head.obj", "coarse_head");
  const std::vector<std::byte> bytes = write_pack(f.character);
  const Result<pack::PackHeader> header = pack::read_header(bytes);
  ASSERT_TRUE(header.ok());
  std::vector<Vec4> image(header.value.image_bytes / sizeof(Vec4) + 1);
  auto loader = std::make_unique<pack::Loader>();
  ASSERT_TRUE(loader->begin(header.value, std::as_writable_bytes(std::span(image))).ok());
  ASSERT_TRUE(loader->feed(std::span(bytes).subspan(sizeof(pack::PackHeader))).ok());
  ASSERT_TRUE(loader->end().ok());
  std::vector<std::byte> memory(agent::Person::arena_bytes(loader->view()));
  Arena arena(memory);
  auto person = std::make_unique<agent::Person>();
  ASSERT_TRUE(person->start(loader->view(), arena).ok());
  ASSERT_TRUE(person->refine(*loader).ok());
  FapFrame neutral, raised;
  person->show(neutral, body::BapFrame{}, Affine{}, 0.0f);
  const Vec3 before = person->feature_point_m(8, 3);
  raised.set(59, 200.0f);
  person->show(raised, body::BapFrame{}, Affine{}, 0.0f);
  const float rise_m = person->feature_point_m(8, 3).y - before.y;
  EXPECT_NEAR(rise_m, 200.0f * f.character.facts.mouth_nose_m / 1024.0f, 1e-4f);
  FapFrame nod;
  nod.set(48, 30000.0f);  // 0.3 rad downwards: the nose falls and comes nearer.
  person->show(nod, body::BapFrame{}, Affine{}, 0.0f);
  EXPECT_LT(person->feature_point_m(9, 3).y, f.head.place_of(9, 3).y - 0.02f);
}

// --- The same stream gives the same expression ---

// Our own people; nullptr without the base human.
const std::vector<Face>* people() {
  static const std::vector<Face> faces = [] {
    std::vector<Face> out;
    if (BaseHuman::missing(BaseHuman::default_folder())) return out;
    const BaseHuman base(BaseHuman::default_folder());
    const auto places = read_feature_points(kCharacters + "feature_points.toml", base);
    for (const char* name : {"woman.toml", "man.toml"}) {
      Face face{build_character(read_recipe(kCharacters + name), base, places), {}};
      face.head = fat::make_head(face.character, base);
      build_fat(face.character, face.head, ranges());
      out.push_back(std::move(face));
    }
    return out;
  }();
  return faces.empty() ? nullptr : &faces;
}

// Where a point of the face goes, across and up, in 1/1024 of this face's own lengths.
Vec2 in_fapu(const Face& face, Vec3 d, int group) {
  const pack::Character& f = face.character.facts;
  const bool lips = group == 2 || group == 8;
  const float across = lips ? f.mouth_width_m : f.eye_separation_m;
  const float up = lips ? f.mouth_nose_m : group == 3 ? f.iris_diameter_m : f.eye_nose_m;
  return {1024.0f * d.x / across, 1024.0f * d.y / up};
}

constexpr std::pair<int, int> kExpressive[] = {
    {2, 1}, {2, 2}, {2, 3}, {2, 4}, {2, 5}, {2, 6}, {2, 7}, {2, 8}, {2, 9}, {3, 1}, {3, 2},
    {3, 3}, {3, 4}, {4, 1}, {4, 2}, {4, 3}, {4, 4}, {4, 5}, {4, 6}, {5, 3}, {5, 4}, {8, 1},
    {8, 2}, {8, 3}, {8, 4}, {8, 5}, {8, 6}, {8, 7}, {8, 8}, {9, 1}, {9, 2}, {9, 3}};

struct Likeness {
  float worst = 0, mean = 0;  // FAPU.
  float share = 0;            // Mean difference by mean movement.
  std::string worst_at;
};

Likeness compare(const Face& a, const Face& b, const std::vector<FapFrame>& frames) {
  Likeness out;
  double sum = 0, moved = 0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const face::FapLimits limits_a = face::limits_of(a.character.channels),
                          limits_b = face::limits_of(b.character.channels);
    face::MixJob mix_a, mix_b;
    mix_a.stream = mix_b.stream = &frames[i];
    mix_a.limits = &limits_a;
    mix_b.limits = &limits_b;
    const FapFrame frame_a = mix_a.run(), frame_b = mix_b.run();
    for (const auto& [group, index] : kExpressive) {
      const Vec2 da = in_fapu(a, a.displacement(frame_a, group, index), group);
      const Vec2 db = in_fapu(b, b.displacement(frame_b, group, index), group);
      const float difference = glm::length(da - db);
      sum += double{difference};
      moved += 0.5 * double{glm::length(da) + glm::length(db)};
      if (difference > out.worst) {
        out.worst = difference;
        out.worst_at = "frame " + std::to_string(i) + " point " + name_of({group, index});
      }
    }
  }
  const double count = static_cast<double>(frames.size() * std::size(kExpressive));
  out.mean = static_cast<float>(sum / count);
  out.share = static_cast<float>(sum / moved);
  return out;
}

// Points move alike within this: 3 % of the way that they go in the mean, and nowhere more than
// 25/1024 of the length that they are measured by (0.5 mm at the mouth).
void expect_alike(const Face& face, const std::vector<FapFrame>& frames) {
  ASSERT_NE(people(), nullptr);
  for (const Face& own : *people()) {
    const Likeness likeness = compare(own, face, frames);
    EXPECT_LT(likeness.share, 0.03f) << own.character.name;
    EXPECT_LT(likeness.worst, 25.0f) << own.character.name << " " << likeness.worst_at;
  }
}

std::vector<FapFrame> emotions() {
  std::vector<FapFrame> out;
  using emotion::Emotion;
  for (const Emotion e : {Emotion::joy, Emotion::sadness, Emotion::anger, Emotion::fear,
                          Emotion::disgust, Emotion::surprise})
    out.push_back(emotion::peak_face(e));
  return out;
}

std::vector<FapFrame> frames_of(const std::filesystem::path& file) {
  const std::string text = test::read_file(file);
  stream::FapTextReader reader({text.data(), text.size()});
  std::vector<FapFrame> out;
  FapFrame frame;
  for (int i = 0; reader.next(&frame).ok(); ++i) {
    if (i % 10 != 0) continue;
    FapFrame full = frame;
    face::limit_to_coding_range(&full);
    face::fill_from_partners(&full);
    out.push_back(full);
  }
  return out;
}

TEST(ForeignHead, EmotionsLookAlikeOnEveryHead) {
  if (!people()) GTEST_SKIP() << *BaseHuman::missing(BaseHuman::default_folder());
  expect_alike(coarse(), emotions());
}

TEST(ForeignHead, AStreamOfOthersLooksAlikeOnEveryHead) {
  if (!people()) GTEST_SKIP() << *BaseHuman::missing(BaseHuman::default_folder());
  CARYATID_NEED_TEST_DATA(jag, "streams/vreng/jag.fap");
  const std::vector<FapFrame> frames = frames_of(jag);
  ASSERT_GT(frames.size(), 10u);
  expect_alike(coarse(), frames);
}

}  // namespace
}  // namespace caryatid::bake::foreign
