#include "assets/tool/animated_png.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <stdexcept>

#include "assets/tool/text_file.h"

namespace caryatid::tool {
namespace {

constexpr std::size_t kColours = 255;  // And one for "as before".
constexpr std::uint8_t kSame = 255;
using Colour = std::array<std::uint8_t, 3>;

std::string number(std::uint32_t value, int bytes = 4) {
  std::string out;
  for (int i = bytes - 1; i >= 0; --i) out += static_cast<char>(value >> (8 * i) & 0xFFu);
  return out;
}

std::string chunk(const std::string& name, const std::string& data) {
  const std::string body = name + data;
  const auto crc =
      crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size()));
  return number(static_cast<std::uint32_t>(data.size())) + body +
         number(static_cast<std::uint32_t>(crc));
}

std::string deflated(const std::string& bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::string out(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(out.data()), &size,
                reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uLong>(bytes.size()),
                Z_BEST_COMPRESSION) != Z_OK)
    throw std::runtime_error("a frame can't be compressed");
  out.resize(size);
  return out;
}

// Median cut (Heckbert 1982) over every seventh pixel of all frames.
std::vector<Colour> palette_of(const std::vector<Picture>& frames) {
  std::vector<Colour> pixels;
  for (const Picture& p : frames)
    for (std::size_t i = 0; i + 2 < p.rgb.size(); i += 21)
      pixels.push_back({p.rgb[i], p.rgb[i + 1], p.rgb[i + 2]});
  struct Box {
    std::size_t first, last;
    std::size_t channel;
    int spread;
  };
  const auto box_of = [&pixels](std::size_t first, std::size_t last) {
    Box out{first, last, 0, -1};
    for (std::size_t c = 0; c < 3; ++c) {
      int low = 255, high = 0;
      for (std::size_t i = first; i < last; ++i) {
        low = std::min(low, int{pixels[i][c]});
        high = std::max(high, int{pixels[i][c]});
      }
      if (high - low > out.spread) out.spread = high - low, out.channel = c;
    }
    return out;
  };
  std::vector<Box> boxes{box_of(0, pixels.size())};
  while (boxes.size() < kColours) {
    // The box whose pixels differ most in sum.
    const auto widest =
        std::max_element(boxes.begin(), boxes.end(), [](const Box& a, const Box& b) {
          return static_cast<double>(a.spread) * static_cast<double>(a.last - a.first) <
                 static_cast<double>(b.spread) * static_cast<double>(b.last - b.first);
        });
    if (widest->spread <= 0) break;
    const Box box = *widest;
    const std::size_t middle = (box.first + box.last) / 2;
    const auto at = [&pixels](std::size_t i) {
      return pixels.begin() + static_cast<std::ptrdiff_t>(i);
    };
    std::nth_element(at(box.first), at(middle), at(box.last),
                     [c = box.channel](const Colour& a, const Colour& b) { return a[c] < b[c]; });
    *widest = box_of(box.first, middle);
    boxes.push_back(box_of(middle, box.last));
  }
  std::vector<Colour> out;
  for (const Box& b : boxes) {
    std::array<std::size_t, 3> sum{};
    for (std::size_t i = b.first; i < b.last; ++i)
      for (std::size_t c = 0; c < 3; ++c) sum[c] += pixels[i][c];
    const std::size_t n = std::max<std::size_t>(b.last - b.first, 1);
    out.push_back({static_cast<std::uint8_t>(sum[0] / n), static_cast<std::uint8_t>(sum[1] / n),
                   static_cast<std::uint8_t>(sum[2] / n)});
  }
  return out;
}

// Nearest colours, remembered by the upper five bits of each channel.
class Palette {
 public:
  explicit Palette(std::vector<Colour> colours) : colours_(std::move(colours)), known_(32768, -1) {}
  std::uint8_t nearest(const std::uint8_t* rgb) {
    const std::size_t key = (std::size_t{rgb[0]} >> 3u) << 10u | (std::size_t{rgb[1]} >> 3u) << 5u |
                            std::size_t{rgb[2]} >> 3u;
    if (known_[key] >= 0) return static_cast<std::uint8_t>(known_[key]);
    int least = 1 << 30;
    for (std::size_t i = 0; i < colours_.size(); ++i) {
      int distance = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        const int d = int{colours_[i][c]} - rgb[c];
        distance += d * d;
      }
      if (distance < least) least = distance, known_[key] = static_cast<int>(i);
    }
    return static_cast<std::uint8_t>(known_[key]);
  }
  const std::vector<Colour>& colours() const { return colours_; }

 private:
  std::vector<Colour> colours_;
  std::vector<int> known_;
};

// Rows of indices, each behind a filter byte; pixels that stay are kSame.
std::string rows_of(const Picture& p, const Picture* before, Palette* palette) {
  std::string out;
  for (std::size_t y = 0; y < p.height; ++y) {
    out += '\0';
    for (std::size_t x = 0; x < p.width; ++x) {
      const std::size_t at = 3 * (y * p.width + x);
      bool same = before != nullptr;
      for (std::size_t c = 0; c < 3 && same; ++c)
        same = std::abs(int{p.rgb[at + c]} - int{before->rgb[at + c]}) <= 2;
      out += static_cast<char>(same ? kSame : palette->nearest(&p.rgb[at]));
    }
  }
  return out;
}

}  // namespace

void write_animated_png(const std::vector<Picture>& frames, unsigned frame_ms,
                        const std::string& path) {
  if (frames.empty()) throw std::runtime_error(path + ": there is nothing to show");
  Palette palette(palette_of(frames));
  const std::uint32_t width = frames[0].width, height = frames[0].height;
  std::string out = "\x89PNG\r\n\x1A\n";
  out += chunk("IHDR", number(width) + number(height) + std::string("\x08\x03\0\0\0", 5));
  out += chunk("acTL", number(static_cast<std::uint32_t>(frames.size())) + number(0));
  std::string colours, alpha(kColours, '\xFF');
  for (std::size_t i = 0; i <= kColours; ++i)
    for (std::size_t c = 0; c < 3; ++c)
      colours += static_cast<char>(i < palette.colours().size() ? palette.colours()[i][c] : 0);
  out += chunk("PLTE", colours) + chunk("tRNS", alpha + '\0');
  std::uint32_t sequence = 0;
  for (std::size_t f = 0; f < frames.size(); ++f) {
    // Left as it is afterwards; drawn over what is there.
    out +=
        chunk("fcTL", number(sequence++) + number(width) + number(height) + number(0) + number(0) +
                          number(frame_ms, 2) + number(1000, 2) + std::string("\0\1", 2));
    const std::string data =
        deflated(rows_of(frames[f], f > 0 ? &frames[f - 1] : nullptr, &palette));
    out += f == 0 ? chunk("IDAT", data) : chunk("fdAT", number(sequence++) + data);
  }
  write_text(path, out + chunk("IEND", ""));
}

}  // namespace caryatid::tool
