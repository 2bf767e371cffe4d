#pragma once
// Pictures of the programme: PNG or JPEG, decoded at start, before memory is sealed.
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace caryatid::app {

// As a texture takes it: powers of two, RGB565, first row on top.
struct Picture {
  std::uint16_t width = 0, height = 0;  // Of the file, for its proportions.
  std::uint16_t texture_width = 0, texture_height = 0;
  std::vector<std::uint16_t> texels;
};

inline constexpr std::size_t kMostPictureBytes = 16u << 20;  // Of a file.
inline constexpr std::uint32_t kMostPictureSide = 8192;
inline constexpr std::int64_t kMostPicturePixels = 24 << 20;

// bytes: the whole file. most_side: of the texture, at most 1024. Its size is looked at before
// anything is decoded. False: one line in out_error, without the file's name.
bool decode_picture(std::string_view bytes, std::uint32_t most_side, Picture* out,
                    std::string* out_error);

}  // namespace caryatid::app
