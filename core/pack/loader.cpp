#include "core/pack/loader.h"

#include <algorithm>
#include <cstring>

#include "core/base/crc.h"

namespace caryatid::pack {
namespace {

constexpr Status refused(Refusal why, Code code = Code::corrupt_data) {
  return {code, static_cast<std::uint16_t>(why)};
}

template <class T>
std::span<const T> typed(std::span<std::byte> image, const Section& s) {
  return {reinterpret_cast<const T*>(image.data() + s.offset), s.bytes / sizeof(T)};
}

// Binds one section to its span in the view. False when its element size is not ours.
bool bind_section(const Section& s, std::span<std::byte> image, View* view) {
  const auto bind = [&]<class T>(std::span<const T>* out) {
    *out = typed<T>(image, s);
    return s.stride == sizeof(T);
  };
  switch (static_cast<SectionId>(s.id)) {
    case SectionId::character:
      view->character = typed<Character>(image, s).data();
      return s.stride == sizeof(Character) && s.bytes == sizeof(Character);
    case SectionId::joints:
      return bind(&view->joints);
    case SectionId::materials:
      return bind(&view->materials);
    case SectionId::textures:
      return bind(&view->textures);
    case SectionId::texels:
      return bind(&view->texels);
    case SectionId::objects:
      return bind(&view->objects);
    case SectionId::versions:
      return bind(&view->versions);
    case SectionId::base_indices:
      return bind(&view->base_indices);
    case SectionId::splits:
      return bind(&view->splits);
    case SectionId::split_data:
      return bind(&view->split_data);
    case SectionId::channels:
      return bind(&view->channels);
    case SectionId::fat_first:
      return bind(&view->fat_first);
    case SectionId::fat_moves:
      return bind(&view->fat_moves);
    case SectionId::feature_points:
      return bind(&view->feature_points);
    case SectionId::rest_face:
      return bind(&view->rest_face);
    case SectionId::licences:
      return bind(&view->licences);
    case SectionId::fit:
      return bind(&view->fit);
  }
  return true;  // A section of a later bake that this build does not need.
}

// What may still arrive after the base part has been checked.
bool is_refinement(SectionId id) {
  return id == SectionId::versions || id == SectionId::fat_first || id == SectionId::fat_moves ||
         id == SectionId::splits || id == SectionId::split_data || id == SectionId::texels;
}

}  // namespace

Result<PackHeader> read_header(std::span<const std::byte> bytes) {
  PackHeader h;
  if (bytes.size() < sizeof h) return {refused(Refusal::too_short), {}};
  std::memcpy(&h, bytes.data(), sizeof h);
  if (std::memcmp(h.magic, kMagic, sizeof h.magic) != 0) return {refused(Refusal::bad_magic), {}};
  if (crc32c(bytes.first(sizeof h - sizeof h.header_crc)) != h.header_crc)
    return {refused(Refusal::header_crc), {}};
  if (h.version != kVersion) return {refused(Refusal::version, Code::unsupported), {}};
  if (h.section_count > kMaxSections || h.chunk_count > kMaxChunks ||
      h.base_chunk_count > h.chunk_count)
    return {refused(Refusal::table_ranges), {}};
  return {{}, h};
}

Status Loader::begin(const PackHeader& header, std::span<std::byte> image) {
  *this = Loader{};
  header_ = header;
  if (image.size() < header.image_bytes) return refuse(Refusal::too_large, Code::out_of_capacity);
  image_ = image.first(header.image_bytes);
  std::memset(image_.data(), 0, image_.size());
  state_ = State::tables;
  return {};
}

Status Loader::refuse(Refusal why, Code code) {
  state_ = State::refused;
  refusal_ = refused(why, code);
  return refusal_;
}

std::span<std::byte> Loader::chunk_target(const Chunk& chunk) const {
  return image_.subspan(sections_[chunk.section].offset + chunk.section_offset, chunk.bytes);
}

Status Loader::feed(std::span<const std::byte> bytes) {
  if (state_ == State::refused) return refusal_;
  if (state_ == State::idle) return {Code::not_ready, 0};
  const auto section_bytes = static_cast<std::uint32_t>(header_.section_count * sizeof(Section));
  const auto table_bytes =
      section_bytes + static_cast<std::uint32_t>(header_.chunk_count * sizeof(Chunk));
  while (!bytes.empty() && state_ == State::tables) {
    const bool in_sections = tables_filled_bytes_ < section_bytes;
    std::byte* to =
        in_sections
            ? reinterpret_cast<std::byte*>(sections_.data()) + tables_filled_bytes_
            : reinterpret_cast<std::byte*>(chunks_.data()) + (tables_filled_bytes_ - section_bytes);
    const std::size_t room = (in_sections ? section_bytes : table_bytes) - tables_filled_bytes_;
    const std::size_t n = std::min(room, bytes.size());
    std::memcpy(to, bytes.data(), n);
    bytes = bytes.subspan(n);
    tables_filled_bytes_ += static_cast<std::uint32_t>(n);
    if (tables_filled_bytes_ == table_bytes) CARYATID_TRY(accept_tables());
  }
  while (!bytes.empty() && state_ == State::chunks) {
    const std::span<std::byte> target = chunk_target(chunks_[chunk_index_]);
    const std::size_t n = std::min(target.size() - chunk_filled_bytes_, bytes.size());
    if (n > 0) std::memcpy(target.data() + chunk_filled_bytes_, bytes.data(), n);
    bytes = bytes.subspan(n);
    chunk_filled_bytes_ += static_cast<std::uint32_t>(n);
    if (chunk_filled_bytes_ == target.size()) CARYATID_TRY(accept_chunk());
  }
  return {};
}

Status Loader::end() {
  if (state_ == State::refused) return refusal_;
  if (state_ == State::complete) return {};
  if (state_ == State::chunks && chunk_filled_bytes_ > 0) {  // Nobody checked what came of it.
    const std::span<std::byte> half =
        chunk_target(chunks_[chunk_index_]).first(chunk_filled_bytes_);
    std::memset(half.data(), 0, half.size());
  }
  return refuse(Refusal::too_short);
}

Status Loader::accept_tables() {
  const std::span sections{sections_.data(), header_.section_count};
  const std::span chunks{chunks_.data(), header_.chunk_count};
  if (crc32c(std::as_bytes(chunks), crc32c(std::as_bytes(sections))) != header_.tables_crc)
    return refuse(Refusal::tables_crc);
  for (const Section& s : sections) {
    if (s.offset % 16 != 0 || s.offset > image_.size() || s.bytes > image_.size() - s.offset ||
        s.stride == 0 || s.bytes % s.stride != 0)
      return refuse(Refusal::table_ranges);
    if (!bind_section(s, image_, &view_)) return refuse(Refusal::table_ranges);
  }
  for (const Section& a : sections)
    for (const Section& b : sections)
      if (&a < &b &&
          (a.id == b.id || (a.offset < b.offset + b.bytes && b.offset < a.offset + a.bytes)))
        return refuse(
            Refusal::table_ranges);  // What was checked in one could be changed in the other.
  for (const Chunk& c : chunks) {
    if (c.section >= header_.section_count || c.bytes == 0) return refuse(Refusal::table_ranges);
    const Section& s = sections_[c.section];
    if (c.section_offset > s.bytes || c.bytes > s.bytes - c.section_offset)
      return refuse(Refusal::table_ranges);
  }
  if (chunks.empty()) return refuse(Refusal::base_incomplete);
  state_ = State::chunks;
  return {};
}

Status Loader::accept_chunk() {
  const Chunk& chunk = chunks_[chunk_index_];
  const std::span<std::byte> target = chunk_target(chunk);
  if (crc32c(target) != chunk.crc) {
    std::memset(target.data(), 0, target.size());
    return refuse(Refusal::chunk_crc);
  }
  if (static_cast<SectionId>(sections_[chunk.section].id) == SectionId::texels)
    for (std::size_t t = 0; t < std::min(view_.textures.size(), kMaxTextures); ++t) {
      const Texture& x = view_.textures[t];
      const std::uint32_t from = std::max(x.texel_offset, chunk.section_offset);
      const std::uint32_t to =
          std::min(x.texel_offset + x.texel_bytes, chunk.section_offset + chunk.bytes);
      if (from < to) texel_bytes_ready_[t] += to - from;
    }
  ++chunk_index_;
  chunk_filled_bytes_ = 0;
  if (chunk_index_ == header_.base_chunk_count) CARYATID_TRY(accept_base());
  if (chunk_index_ > header_.base_chunk_count) CARYATID_TRY(count_refinement(chunk));
  if (chunk_index_ == header_.chunk_count) state_ = State::complete;
  return {};
}

Status Loader::accept_base() {
  if (const Status s = validate_view(view_); !s.ok()) return refuse(static_cast<Refusal>(s.detail));
  base_ready_ = true;
  return {};
}

Status Loader::count_refinement(const Chunk& chunk) {
  const Section& section = sections_[chunk.section];
  const auto id = static_cast<SectionId>(section.id);
  if (!is_refinement(id)) return refuse(Refusal::bad_split_order);
  if (const Status s = validate_elements(view_, id, chunk.section_offset / section.stride,
                                         (chunk.bytes + section.stride - 1) / section.stride);
      !s.ok())
    return refuse(static_cast<Refusal>(s.detail));
  if (id != SectionId::splits) return {};
  if (chunk.section_offset % sizeof(Split) != 0 || chunk.bytes % sizeof(Split) != 0)
    return refuse(Refusal::bad_split_order);
  const auto first = static_cast<std::uint32_t>(chunk.section_offset / sizeof(Split));
  const auto count = static_cast<std::uint32_t>(chunk.bytes / sizeof(Split));
  for (std::size_t o = 0; o < view_.objects.size(); ++o) {
    const Object& object = view_.objects[o];
    if (first != object.first_split + splits_ready_[o] || splits_ready_[o] == object.split_count)
      continue;
    if (count > object.split_count - splits_ready_[o]) break;
    splits_ready_[o] += count;
    return {};
  }
  return refuse(Refusal::bad_split_order);
}

bool Loader::texture_complete(std::size_t texture) const {
  return texture < view_.textures.size() && texture < kMaxTextures &&
         texel_bytes_ready_[texture] >= view_.textures[texture].texel_bytes;
}

const char* refusal_text(Refusal refusal) {
  switch (refusal) {
    case Refusal::none:
      return "no fault";
    case Refusal::too_short:
      return "the file is cut short; copy or bake it again";
    case Refusal::bad_magic:
      return "this is not a Caryatid pack; name a file made by caryatid-tool bake";
    case Refusal::header_crc:
      return "the header is damaged; copy or bake it again";
    case Refusal::version:
      return "made by another version of caryatid-tool; bake it again";
    case Refusal::too_large:
      return "larger than the agent's memory; bake it with smaller textures";
    case Refusal::tables_crc:
      return "the tables are damaged; copy or bake it again";
    case Refusal::table_ranges:
      return "a section lies outside the file; bake it again";
    case Refusal::missing_section:
      return "a section is missing; bake it again";
    case Refusal::chunk_crc:
      return "the data is damaged; copy or bake it again";
    case Refusal::base_incomplete:
      return "the base part is incomplete; bake it again";
    case Refusal::bad_joint:
      return "a joint of the skeleton is wrong; bake it again";
    case Refusal::bad_object:
      return "an object of the character is wrong; bake it again";
    case Refusal::bad_material:
      return "a material is wrong; bake it again";
    case Refusal::bad_texture:
      return "a texture is wrong; bake it again";
    case Refusal::bad_index:
      return "a triangle names a missing vertex; bake it again";
    case Refusal::bad_channel:
      return "a face animation channel is wrong; bake it again";
    case Refusal::bad_move:
      return "the face animation table is wrong; bake it again";
    case Refusal::bad_feature_point:
      return "a feature point is wrong; bake it again";
    case Refusal::bad_number:
      return "a number is not finite; bake it again";
    case Refusal::bad_fit:
      return "a rule of FAP interpolation is wrong; bake it again";
    case Refusal::bad_split_order:
      return "the refinements are out of order; bake it again";
  }
  return "unknown fault";
}

}  // namespace caryatid::pack
