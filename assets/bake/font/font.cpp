#include "assets/bake/font/font.h"

#include <ft2build.h>
#include FT_FREETYPE_H
#include <hb-ot.h>
#include <hb-subset.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <set>
#include <stdexcept>

#include "core/base/crc.h"
#include "core/pack/font.h"

namespace caryatid::bake {
namespace {

template <auto destroy>
struct Deleter {
  template <class T>
  void operator()(T* p) const {
    destroy(p);
  }
};
using Blob = std::unique_ptr<hb_blob_t, Deleter<hb_blob_destroy>>;
using Face = std::unique_ptr<hb_face_t, Deleter<hb_face_destroy>>;
using SubsetInput = std::unique_ptr<hb_subset_input_t, Deleter<hb_subset_input_destroy>>;
using CodeSet = std::unique_ptr<hb_set_t, Deleter<hb_set_destroy>>;

struct Glyph {
  pack::FontGlyph place{};
  std::vector<unsigned char> field;  // place.width * place.height
};

struct BakedFace {
  pack::FontFace face{};
  std::vector<Glyph> glyphs;
  std::string sfnt;  // Without outlines.
};

// The font cut down to `wanted`, with every form that its substitutions can reach. The second time
// without outlines: what a shaper needs.
Blob subset(hb_face_t* face, const hb_set_t* wanted, bool outlines) {
  SubsetInput input(hb_subset_input_create_or_fail());
  hb_set_union(hb_subset_input_unicode_set(input.get()), wanted);
  hb_subset_input_set_flags(input.get(), HB_SUBSET_FLAGS_NO_HINTING);
  // Every script that the code points have, and the features that a shaper turns on by itself.
  hb_set_t* drop = hb_subset_input_set(input.get(), HB_SUBSET_SETS_DROP_TABLE_TAG);
  for (const char* tag : {"name", "post", "DSIG", "gasp", "meta"})
    hb_set_add(drop, hb_tag_from_string(tag, 4));
  if (!outlines)
    for (const char* tag : {"glyf", "loca"}) hb_set_add(drop, hb_tag_from_string(tag, 4));
  Face out(hb_subset_or_fail(face, input.get()));
  if (!out) throw std::runtime_error("the font can't be cut down; use another");
  return Blob(hb_face_reference_blob(out.get()));
}

// Glyphs are drawn so many times finer than the field: outlines may overlap themselves, which a
// field taken from the curves would show as notches.
constexpr int kFine = 8;

// n / kFine, rounded down.
int floor_of(int n) { return n >= 0 ? n / kFine : -((-n + kFine - 1) / kFine); }

// What is ink on the fine grid, and the distance field of it.
class FineMask {
 public:
  FineMask(int width, int height)
      : width_(width), height_(height), ink_(std::size_t(width) * std::size_t(height)) {}
  void set(int x, int y, bool ink) { ink_[index(x, y)] = ink; }

  // A texel for kFine x kFine pixels, 128 at the edge, 255 and 0 at spread texels in and out.
  std::vector<unsigned char> field(int spread) const {
    const int reach = spread * kFine;
    const std::vector<int> to_ink = columns(true, reach), to_paper = columns(false, reach);
    std::vector<unsigned char> out;
    for (int y = kFine / 2; y < height_; y += kFine)
      for (int x = kFine / 2; x < width_; x += kFine) {
        const double outside = nearest(to_ink, x, y, reach);
        const double inside = nearest(to_paper, x, y, reach);
        const double depth = (inside > 0.0 ? inside - 0.5 : 0.5 - outside) / reach;
        out.push_back(
            static_cast<unsigned char>(std::clamp(std::lround(128.0 + 127.0 * depth), 0l, 255l)));
      }
    return out;
  }

 private:
  std::size_t index(int x, int y) const {
    return std::size_t(y) * std::size_t(width_) + std::size_t(x);
  }
  // Distance of each pixel to the nearest one of that kind in its column.
  std::vector<int> columns(bool ink, int most) const {
    std::vector<int> out(ink_.size(), most);
    for (int x = 0; x < width_; ++x) {
      int distance = most;
      for (int y = 0; y < height_; ++y) {
        distance = ink_[index(x, y)] == ink ? 0 : std::min(distance + 1, most);
        out[index(x, y)] = distance;
      }
      distance = most;
      for (int y = height_ - 1; y >= 0; --y) {
        distance = ink_[index(x, y)] == ink ? 0 : std::min(distance + 1, most);
        out[index(x, y)] = std::min(out[index(x, y)], distance);
      }
    }
    return out;
  }
  double nearest(const std::vector<int>& column, int x, int y, int reach) const {
    int best = reach * reach;
    for (int i = std::max(0, x - reach); i < std::min(width_, x + reach); ++i) {
      const int d = column[index(i, y)], dx = i - x;
      best = std::min(best, d * d + dx * dx);
    }
    return std::sqrt(double(best));
  }

  int width_, height_;
  std::vector<bool> ink_;
};

class Outlines {
 public:
  Outlines(hb_blob_t* blob, const FontRequest& request) : request_(request) {
    if (FT_Init_FreeType(&library_) != 0) throw std::runtime_error("FreeType does not start");
    unsigned size = 0;
    const char* data = hb_blob_get_data(blob, &size);
    if (FT_New_Memory_Face(library_, reinterpret_cast<const FT_Byte*>(data),
                           static_cast<FT_Long>(size), 0, &face_) != 0 ||
        FT_Set_Pixel_Sizes(face_, 0, kFine * request.em_px) != 0)
      throw std::runtime_error("the font has no outlines that FreeType can read; use another");
  }
  Outlines(const Outlines&) = delete;
  Outlines& operator=(const Outlines&) = delete;
  ~Outlines() {
    FT_Done_Face(face_);
    FT_Done_FreeType(library_);
  }
  FT_Face face() const { return face_; }

  Glyph glyph(unsigned id) const {
    Glyph g;
    g.place.glyph_id = static_cast<std::uint16_t>(id);
    if (FT_Load_Glyph(face_, id, FT_LOAD_NO_HINTING | FT_LOAD_NO_BITMAP) != 0) return g;
    if (face_->glyph->outline.n_points == 0) return g;
    if (FT_Render_Glyph(face_->glyph, FT_RENDER_MODE_NORMAL) != 0)
      throw std::runtime_error("a glyph's outline is broken; use another font");
    const FT_Bitmap& bitmap = face_->glyph->bitmap;
    const int spread = static_cast<int>(request_.spread_px);
    const int left = floor_of(face_->glyph->bitmap_left) - spread;
    const int top = -floor_of(-face_->glyph->bitmap_top) + spread;
    const int right = -floor_of(-face_->glyph->bitmap_left - int(bitmap.width)) + spread;
    const int bottom = floor_of(face_->glyph->bitmap_top - int(bitmap.rows)) - spread;
    g.place.width = static_cast<std::uint16_t>(right - left);
    g.place.height = static_cast<std::uint16_t>(top - bottom);
    const double unit = double(pack::kUnitsPerEm) / request_.em_px;
    g.place.left = static_cast<std::int16_t>(std::lround(left * unit));
    g.place.top = static_cast<std::int16_t>(std::lround(top * unit));
    FineMask mask(kFine * (right - left), kFine * (top - bottom));
    const int x0 = face_->glyph->bitmap_left - kFine * left;
    const int y0 = kFine * top - face_->glyph->bitmap_top;
    for (int y = 0; y < int(bitmap.rows); ++y)
      for (int x = 0; x < int(bitmap.width); ++x)
        mask.set(x0 + x, y0 + y, bitmap.buffer[std::ptrdiff_t(y) * bitmap.pitch + x] >= 128);
    g.field = mask.field(spread);
    return g;
  }

 private:
  const FontRequest& request_;
  FT_Library library_ = nullptr;
  FT_Face face_ = nullptr;
};

// A disc of radius `spread`: its middle is deep inside, so that a box is nine stretched pieces.
Glyph disc(const FontRequest& request) {
  Glyph g;
  const int spread = static_cast<int>(request.spread_px), side = 4 * spread;
  g.place.glyph_id = 0xFFFF;
  g.place.width = g.place.height = static_cast<std::uint16_t>(side);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const double dx = x + 0.5 - 2 * spread, dy = y + 0.5 - 2 * spread;
      const double inside = (spread - std::sqrt(dx * dx + dy * dy)) / spread;
      g.field.push_back(
          static_cast<unsigned char>(std::clamp(std::lround(128.0 + 127.0 * inside), 0l, 255l)));
    }
  return g;
}

BakedFace bake_face(const std::string& file, const hb_set_t* wanted, const FontRequest& request) {
  Blob blob(hb_blob_create_from_file_or_fail(file.c_str()));
  if (!blob) throw std::runtime_error(file + ": can't be read; install the package of the font");
  Face face(hb_face_create(blob.get(), 0));
  const Blob drawn = subset(face.get(), wanted, true), bare = subset(face.get(), wanted, false);
  const Outlines outlines(drawn.get(), request);
  BakedFace out;
  const std::string name =
      std::string(outlines.face()->family_name ? outlines.face()->family_name : "");
  const std::string stem = file.substr(file.rfind('/') + 1);
  std::snprintf(out.face.name, sizeof out.face.name, "%s", stem.substr(0, stem.rfind('.')).c_str());
  const double unit = double(pack::kUnitsPerEm) / outlines.face()->units_per_EM;
  out.face.ascent = static_cast<std::int16_t>(std::lround(outlines.face()->ascender * unit));
  out.face.descent = static_cast<std::int16_t>(std::lround(outlines.face()->descender * unit));
  const auto count = static_cast<unsigned>(outlines.face()->num_glyphs);
  for (unsigned id = 0; id < count; ++id) out.glyphs.push_back(outlines.glyph(id));
  unsigned size = 0;
  const char* data = hb_blob_get_data(bare.get(), &size);
  out.sfnt.assign(data, size);
  return out;
}

// Rows of falling height: glyphs are so alike that this wastes a few per cent.
double pack_atlas(std::vector<Glyph*> glyphs, const FontRequest& request,
                  std::vector<std::byte>* out) {
  std::stable_sort(glyphs.begin(), glyphs.end(), [](const Glyph* a, const Glyph* b) {
    return a->place.height > b->place.height;
  });
  const unsigned side = request.atlas_side;
  out->assign(std::size_t{side} * side, std::byte{0});
  unsigned x = 0, y = 0, row_height = 0, filled = 0;
  for (Glyph* g : glyphs) {
    const unsigned w = g->place.width, h = g->place.height;
    if (w == 0) continue;
    if (x + w > side) {
      x = 0;
      y += row_height + 1;
      row_height = 0;
    }
    if (y + h > side) throw std::runtime_error("the glyphs do not fit; choose a smaller --em");
    g->place.x = static_cast<std::uint16_t>(x);
    g->place.y = static_cast<std::uint16_t>(y);
    for (unsigned row = 0; row < h; ++row)
      std::memcpy(out->data() + std::size_t{y + row} * side + x, g->field.data() + row * w, w);
    x += w + 1;
    row_height = std::max(row_height, h);
    filled += w * h;
  }
  return double(filled) / (double(side) * side);
}

template <class T>
void append(std::vector<std::byte>* out, const T& value) {
  const auto* bytes = reinterpret_cast<const std::byte*>(&value);
  out->insert(out->end(), bytes, bytes + sizeof value);
}

std::vector<std::byte> write(std::vector<BakedFace>& faces, const FontRequest& request,
                             FontReport* report) {
  std::vector<Glyph*> all;
  for (BakedFace& f : faces)
    for (Glyph& g : f.glyphs) all.push_back(&g);
  std::vector<std::byte> atlas;
  report->atlas_filled = pack_atlas(all, request, &atlas);
  report->glyphs = all.size();
  pack::FontHeader h{};
  std::memcpy(h.magic, pack::kFontMagic, sizeof h.magic);
  h.version = pack::kFontVersion;
  h.face_count = static_cast<std::uint16_t>(faces.size());
  h.glyph_count = static_cast<std::uint16_t>(all.size());
  h.atlas_width = h.atlas_height = static_cast<std::uint16_t>(request.atlas_side);
  h.em_px = static_cast<std::uint16_t>(request.em_px);
  h.spread_px = static_cast<std::uint16_t>(request.spread_px);
  h.box_glyph = static_cast<std::uint32_t>(all.size() - 1);
  h.atlas_offset = static_cast<std::uint32_t>(sizeof h + faces.size() * sizeof(pack::FontFace) +
                                              all.size() * sizeof(pack::FontGlyph));
  std::uint32_t sfnt = h.atlas_offset + static_cast<std::uint32_t>(atlas.size());
  std::uint16_t first = 0;
  std::vector<std::byte> body;
  for (BakedFace& f : faces) {
    f.face.sfnt_offset = sfnt;
    f.face.sfnt_bytes = static_cast<std::uint32_t>(f.sfnt.size());
    f.face.first_glyph = first;
    f.face.glyph_count = static_cast<std::uint16_t>(f.glyphs.size());
    first = static_cast<std::uint16_t>(first + f.face.glyph_count);
    sfnt += (f.face.sfnt_bytes + 3) / 4 * 4;
    append(&body, f.face);
  }
  for (const Glyph* g : all) append(&body, g->place);
  body.insert(body.end(), atlas.begin(), atlas.end());
  for (BakedFace& f : faces) {
    f.sfnt.resize((f.sfnt.size() + 3) / 4 * 4, '\0');
    const auto* bytes = reinterpret_cast<const std::byte*>(f.sfnt.data());
    body.insert(body.end(), bytes, bytes + f.sfnt.size());
  }
  h.bytes = static_cast<std::uint32_t>(sizeof h + body.size());
  h.crc = crc32c(body);
  std::vector<std::byte> out;
  append(&out, h);
  out.insert(out.end(), body.begin(), body.end());
  return out;
}

}  // namespace

std::vector<char32_t> caption_code_points() {
  constexpr char32_t kRanges[][2] = {
      {0x20, 0x7E},     {0xA0, 0x17F},    {0x192, 0x192},   {0x218, 0x21B},   {0x2C6, 0x2DD},
      {0x300, 0x304},   {0x306, 0x30C},   {0x313, 0x314},   {0x342, 0x345},   {0x37A, 0x37F},
      {0x384, 0x3CE},   {0x3D7, 0x3D7},   {0x400, 0x45F},   {0x48A, 0x4B9},   {0x4D8, 0x4D9},
      {0x5B0, 0x5BC},   {0x5BE, 0x5BE},   {0x5C1, 0x5C2},   {0x5D0, 0x5EA},   {0x5F3, 0x5F4},
      {0x60C, 0x60C},   {0x61B, 0x61B},   {0x61F, 0x61F},   {0x621, 0x63A},   {0x640, 0x652},
      {0x660, 0x669},   {0x670, 0x671},   {0x67E, 0x67E},   {0x686, 0x686},   {0x698, 0x698},
      {0x6A9, 0x6A9},   {0x6AF, 0x6AF},   {0x6CC, 0x6CC},   {0x1E80, 0x1E85}, {0x1E9E, 0x1E9E},
      {0x1EF2, 0x1EF3}, {0x1F00, 0x1FFE}, {0x2010, 0x2015}, {0x2018, 0x201E}, {0x2020, 0x2022},
      {0x2026, 0x2026}, {0x2030, 0x2030}, {0x2032, 0x2033}, {0x2039, 0x203A}, {0x20AA, 0x20AC},
      {0x20B4, 0x20B4}, {0x20BD, 0x20BD}, {0x2116, 0x2116}, {0x2122, 0x2122}, {0x2190, 0x2193},
      {0x2212, 0x2212}, {0xFFFD, 0xFFFD}};
  std::vector<char32_t> out;
  for (const auto& range : kRanges)
    for (char32_t c = range[0]; c <= range[1]; ++c) out.push_back(c);
  return out;
}

std::vector<std::byte> bake_font(const FontRequest& request, FontReport* out_report) {
  std::set<char32_t> missing;
  for (const char32_t c : caption_code_points()) missing.insert(c);
  const std::size_t wanted_count = missing.size();
  std::vector<BakedFace> faces;
  for (const std::string& file : request.files) {
    Blob blob(hb_blob_create_from_file_or_fail(file.c_str()));
    if (!blob) throw std::runtime_error(file + ": can't be read; install the package of the font");
    Face face(hb_face_create(blob.get(), 0));
    CodeSet has(hb_set_create()), take(hb_set_create());
    hb_face_collect_unicodes(face.get(), has.get());
    for (const char32_t c : missing)
      if (hb_set_has(has.get(), c)) hb_set_add(take.get(), c);
    // A right-to-left face brings its own blank and full stop, so that runs need not be torn.
    if (!faces.empty())
      for (const char32_t c : {U' ', U'.', U'!'})
        if (hb_set_has(has.get(), c)) hb_set_add(take.get(), c);
    faces.push_back(bake_face(file, take.get(), request));
    for (hb_codepoint_t c = HB_SET_VALUE_INVALID; hb_set_next(take.get(), &c);) missing.erase(c);
  }
  if (faces.empty()) throw std::runtime_error("no font was named");
  faces.back().glyphs.push_back(disc(request));
  *out_report = {};
  out_report->code_points = wanted_count - missing.size();
  return write(faces, request, out_report);
}

}  // namespace caryatid::bake
