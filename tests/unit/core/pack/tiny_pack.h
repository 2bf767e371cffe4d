#pragma once
// The smallest whole pack, built by hand from the format's own words (not by the bake's writer):
// one joint, one triangle, one refinement chunk of zero-length meaning. Tests break it in every
// way.
#include <cstring>
#include <string_view>
#include <vector>

#include "core/base/crc.h"
#include "core/pack/loader.h"

namespace caryatid::pack {

class TinyPack {
 public:
  TinyPack() {
    Character c{};
    std::strcpy(c.name, "tiny");
    c.iris_diameter_m = 0.012f;
    c.eye_separation_m = 0.062f;
    c.eye_nose_m = 0.045f;
    c.mouth_nose_m = 0.022f;
    c.mouth_width_m = 0.05f;
    c.stature_m = 1.7f;
    c.leg_length_m = 0.9f;
    c.total_triangles = 1;
    add(SectionId::character, {c});
    add(SectionId::joints, {Joint{{0, 1, 0}, kNoJoint, 0}});
    add(SectionId::materials, {Material{MaterialKind::skin, 0, 0, kNoTexture, {1, 1, 1, 1}, 0, 8}});
    add(SectionId::textures, {Texture{2, 2, TextureFormat::rgb565, 2, 0, 10, 1}});
    add(SectionId::texels, std::vector<std::byte>(10));
    Object o{};
    std::strcpy(o.name, "skin");
    o.bone_count = 1;
    o.version_count = 3;
    o.base_vertex_count = 3;
    o.max_vertex_count = 3;
    o.base_triangle_count = 1;
    o.max_triangle_count = 1;
    add(SectionId::objects, {o});
    add(SectionId::versions, std::vector<Vertex>(3, Vertex{{0, 1, 0}, {}, {}, {}, {255, 0, 0, 0}}));
    add(SectionId::base_indices, std::vector<std::uint16_t>{0, 1, 2});
    add(SectionId::splits, std::vector<Split>{});
    add(SectionId::split_data, std::vector<std::uint16_t>{});
    add(SectionId::channels, {Channel{3, 0, 0, 100, 0, 0}});
    add(SectionId::fat_first, std::vector<std::uint32_t>{0, 1, 1, 1});
    add(SectionId::fat_moves, {Move{0, {0, -100, 0}, {}, 0}});
    add(SectionId::feature_points, {FeaturePoint{2, 1, 0, 0, {0, 1, 0}}});
    add(SectionId::rest_face, std::vector<float>(69));
    add(SectionId::licences, std::vector<char>{'C', 'C', '0'});
    FitRule rule{};  // FAP 7 = FAP 6.
    rule.receiver = 7;
    rule.numerator_count = 1;
    rule.numerator[0] = {1.0f, {6, 0}, {1, 0}};
    add(SectionId::fit, {rule});
  }

  // The bytes of section `id`, to be changed before file() is called.
  template <class T>
  T* edit(SectionId id) {
    for (auto& part : parts_)
      if (part.id == id) return reinterpret_cast<T*>(part.bytes.data());
    return nullptr;
  }
  void drop(SectionId id) {
    std::erase_if(parts_, [id](const Part& p) { return p.id == id; });
  }

  // The file. The texels are a chunk of their own after the base part.
  std::vector<std::byte> file() const {
    std::vector<Section> sections;
    std::vector<Chunk> chunks;
    std::vector<std::byte> payload;
    std::uint32_t offset = 0;
    const auto emit = [&](const Part& part, std::uint32_t section) {
      if (part.bytes.empty()) return;
      chunks.push_back(
          {section, 0, static_cast<std::uint32_t>(part.bytes.size()), crc32c(part.bytes)});
      payload.insert(payload.end(), part.bytes.begin(), part.bytes.end());
    };
    for (const Part& part : parts_) {
      const auto bytes = static_cast<std::uint32_t>(part.bytes.size());
      sections.push_back({static_cast<std::uint32_t>(part.id), offset, bytes, part.stride});
      offset = (offset + bytes + 15u) & ~15u;
    }
    for (std::uint32_t s = 0; s < parts_.size(); ++s)
      if (parts_[s].id != SectionId::texels) emit(parts_[s], s);
    const auto base_chunks = static_cast<std::uint32_t>(chunks.size());
    for (std::uint32_t s = 0; s < parts_.size(); ++s)
      if (parts_[s].id == SectionId::texels) emit(parts_[s], s);
    PackHeader h{};
    std::memcpy(h.magic, kMagic, sizeof kMagic);
    h.version = kVersion;
    h.section_count = static_cast<std::uint32_t>(sections.size());
    h.chunk_count = static_cast<std::uint32_t>(chunks.size());
    h.base_chunk_count = base_chunks;
    h.image_bytes = offset;
    h.arena_bytes = offset;
    const auto section_bytes = std::as_bytes(std::span(sections));
    const auto chunk_bytes = std::as_bytes(std::span(chunks));
    h.file_bytes = static_cast<std::uint32_t>(sizeof h + section_bytes.size() + chunk_bytes.size() +
                                              payload.size());
    h.tables_crc = crc32c(chunk_bytes, crc32c(section_bytes));
    h.header_crc = crc32c(std::as_bytes(std::span(&h, 1)).first(60));
    std::vector<std::byte> out;
    const auto append = [&out](std::span<const std::byte> b) {
      out.insert(out.end(), b.begin(), b.end());
    };
    append(std::as_bytes(std::span(&h, 1)));
    append(section_bytes);
    append(chunk_bytes);
    append(payload);
    return out;
  }

 private:
  struct Part {
    SectionId id;
    std::uint32_t stride;
    std::vector<std::byte> bytes;
  };
  template <class T>
  void add(SectionId id, std::vector<T> values) {
    const auto bytes = std::as_bytes(std::span(values));
    parts_.push_back({id, sizeof(T), {bytes.begin(), bytes.end()}});
  }
  template <class T>
  void add(SectionId id, std::initializer_list<T> values) {
    add(id, std::vector<T>(values));
  }
  std::vector<Part> parts_;
};

}  // namespace caryatid::pack
