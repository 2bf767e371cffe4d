#pragma once
// Reads a pack file as its bytes arrive and fills the image (see pack.h).
//
// States: header -> tables -> chunks -> complete; any refusal is final but keeps what was loaded:
// after the base part the character stays usable at the last good level.
// Ownership: borrows the image; copies what it needs of the tables. No allocation.
// Cost: O(bytes fed), one CRC and one copy.
#include <array>
#include <span>

#include "core/base/status.h"
#include "core/pack/view.h"

namespace caryatid::pack {

// Why a pack was refused: Status::detail of everything in this room.
enum class Refusal : std::uint16_t {
  none,
  too_short,        // The file ends before its header says so.
  bad_magic,        // Not a pack.
  header_crc,       // The header is damaged.
  version,          // Made by another version of the bake: bake again.
  too_large,        // Larger than the memory given.
  tables_crc,       // The tables are damaged.
  table_ranges,     // A section or chunk lies outside the image.
  missing_section,  // A section of this version is not there.
  chunk_crc,        // A chunk is damaged.
  base_incomplete,  // The base chunks leave a needed section empty.
  bad_joint,        // Parent after child, or too many joints.
  bad_object,       // An object's ranges, material or bones do not exist.
  bad_material,
  bad_texture,
  bad_index,    // A base triangle names a vertex that is not there.
  bad_channel,  // A channel's FAP or limits make no sense.
  bad_move,     // FAT ranges or channels out of order.
  bad_feature_point,
  bad_number,       // NaN or infinity where a length stands.
  bad_fit,          // A rule of FAP interpolation that no FIT can hold.
  bad_split_order,  // Refinements arrive out of order.
};
// One line in English for a message to the deployer.
const char* refusal_text(Refusal refusal);

inline constexpr std::size_t kMaxSections = 24;
inline constexpr std::size_t kMaxChunks = 512;

// The header alone, checked: magic, version, CRC, sizes. `bytes` holds at least 64.
// corrupt_data or unsupported with a Refusal as detail.
Result<PackHeader> read_header(std::span<const std::byte> bytes);

class Loader {
 public:
  // image: at least header.image_bytes long and 16-byte aligned; it is zeroed here. header: from
  // read_header. out_of_capacity (too_large) when the image is too short.
  Status begin(const PackHeader& header, std::span<std::byte> image);

  // The file's bytes after the header, in order, in pieces of any size.
  // corrupt_data: this and every later call refuses; base_ready() and the counts stay as they are.
  Status feed(std::span<const std::byte> bytes);
  // Tells that no more bytes will come: corrupt_data (too_short) when the file was cut.
  Status end();

  bool base_ready() const { return base_ready_; }
  bool complete() const { return state_ == State::complete; }
  // How many splits of each object may be applied now.
  std::uint32_t splits_ready(std::size_t object) const { return splits_ready_[object]; }
  // Whether all levels of a texture are there; until then only those from base_level on.
  bool texture_complete(std::size_t texture) const;
  const View& view() const { return view_; }

 private:
  enum class State : std::uint8_t { idle, tables, chunks, complete, refused };

  Status refuse(Refusal why, Code code = Code::corrupt_data);
  Status accept_tables();
  Status accept_chunk();
  Status accept_base();
  Status count_refinement(const Chunk& chunk);
  std::span<std::byte> chunk_target(const Chunk& chunk) const;

  State state_ = State::idle;
  bool base_ready_ = false;
  Status refusal_{};
  PackHeader header_{};
  std::span<std::byte> image_;
  std::array<Section, kMaxSections> sections_{};
  std::array<Chunk, kMaxChunks> chunks_{};
  std::uint32_t tables_filled_bytes_ = 0;
  std::uint32_t chunk_index_ = 0;
  std::uint32_t chunk_filled_bytes_ = 0;
  std::array<std::uint32_t, kMaxObjects> splits_ready_{};
  std::array<std::uint32_t, kMaxTextures> texel_bytes_ready_{};
  View view_;
};

// Checks everything in the image that later code trusts (index ranges, finite numbers, orders) but
// the splits, which core/mesh checks as it takes them. Only the base part need be filled.
Status validate_view(const View& view);

// The same for one element range of a section that arrived after the base part.
Status validate_elements(const View& view, SectionId section, std::uint32_t first,
                         std::uint32_t count);

}  // namespace caryatid::pack
