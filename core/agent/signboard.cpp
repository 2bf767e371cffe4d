#include "core/agent/signboard.h"

#include <algorithm>
#include <cmath>

#include "core/base/crc.h"

namespace caryatid::agent {

using scene::Box;
using scene::Ink;
using scene::TextStyle;

// Every pair of letter and ground has a contrast of at least 7 to 1 (WCAG 2.1, AAA) but the words
// that are still to come, 4.5 to 1 (AA).
struct Signboard::Palette {
  Ink card{17, 22, 30, 222}, caption{8, 11, 16, 205};
  Ink title{255, 255, 255, 255}, body{218, 225, 234, 255}, label{240, 244, 248, 255};
  Ink badge{245, 196, 81, 255}, badge_text{24, 20, 8, 255};
  Ink said{255, 255, 255, 255}, word{255, 214, 102, 255}, to_come{165, 174, 186, 255};
  Ink outline{0, 0, 0, 255};

  static Palette of(bool high_contrast) {
    Palette p;
    if (!high_contrast) return p;
    p.card = p.caption = {0, 0, 0, 255};
    p.body = p.label = p.to_come = p.said = {255, 255, 255, 255};
    p.badge = p.word = {255, 235, 0, 255};
    p.badge_text = {0, 0, 0, 255};
    return p;
  }
};

namespace {

constexpr float kStageRate = 5.0f, kFadeRate = 9.0f, kDimRate = 2.5f;  // 1/s, see Follower.
constexpr float kAsleep = 0.94f;                                // How dark the scene is then.
constexpr float kLineHeight = 1.32f, kAscent = 0.98f;           // Of the letters' size.
constexpr float kTitle = 1.55f, kPadding = 1.0f, kGap = 0.55f;  // Of the card's letters.
// The least height of a picture, of the letters' size; the most width beside text, of the card's.
constexpr float kLeastPicture = 4.5f, kColumn = 0.40f;
constexpr float kUsual = 0.69f;  // Letters of a card that is full, of those that were asked for.

float em(std::int32_t width, float size_px) {
  return static_cast<float>(width) * size_px / pack::kUnitsPerEm;
}

bool leftwards(std::span<const scene::Run> runs) {
  for (const scene::Run& r : runs)
    if (!r.blank) return r.level % 2 != 0;
  return false;
}

// Word by word a text is in one of three states.
Ink ink_of(const scene::Run& run, std::int32_t word_byte, bool speaking, const Ink& said,
           const Ink& word, const Ink& to_come) {
  if (!speaking) return said;
  const std::int32_t begin = run.text_begin, end = run.text_end;
  if (word_byte >= begin && word_byte < end) return word;
  return begin <= word_byte ? said : to_come;
}

}  // namespace

Layout Signboard::layout(const SignboardInput& input) const {
  return lay_out({.width = input.width,
                  .height = input.height,
                  .card = input.guidance->visited && !is_empty(input),
                  .large_text = input.guidance->large_text,
                  .mirrored = mirrored_,
                  .captions = input.guidance->captions && silence_s_ <= kStay_s});
}

// Where she stands in the card's way it changes sides, if it is out of her way there.
void Signboard::give_way(const SignboardInput& input) {
  if (!layout_.card.overlaps(input.head)) return;
  fade_ = {};
  mirrored_ = !mirrored_;
  const Layout other = layout(input);
  if (other.card.overlaps(input.head))
    mirrored_ = !mirrored_;
  else
    layout_ = other;
}

const Box& Signboard::stage(const SignboardInput& input, float dt_s) {
  if (!input.guidance->visited) mirrored_ = false;
  layout_ = layout(input);
  // From afar she has the whole picture to walk in.
  const Box& b = layout_.person;
  const float near = std::clamp(input.closeness, 0.0f, 1.0f);
  const float targets[4] = {near * b.x0 / input.width, near * b.y0 / input.height,
                            1.0f + near * (b.x1 / input.width - 1.0f),
                            1.0f + near * (b.y1 / input.height - 1.0f)};
  for (int i = 0; i < 4; ++i) {
    if (!placed_) edge_[i].value = targets[i];
    edge_[i].step(targets[i], kStageRate, std::clamp(dt_s, 0.0f, 0.1f));
  }
  placed_ = true;
  stage_ = {edge_[0].value * input.width, edge_[1].value * input.height,
            edge_[2].value * input.width, edge_[3].value * input.height};
  return stage_;
}

bool Signboard::expand_text(std::uint16_t text, const SignboardInput& input) {
  const Line* line = input.programme->line(text, input.guidance->language);
  if (line == nullptr) return false;
  expand(*input.programme, *line, input.now, &text_);
  return !text_.runs.empty();
}

// Draws or measures a text in lines from the upper end of `at`; its height.
float Signboard::text_block(std::uint16_t text, const SignboardInput& input, const Box& at,
                            const TextStyle& style, bool draw) {
  if (!expand_text(text, input)) return 0.0f;
  scene::break_lines(text_.runs.span(),
                     static_cast<std::int32_t>(at.width() * pack::kUnitsPerEm / style.size_px),
                     &lines_);
  const float step = kLineHeight * style.size_px;
  if (draw) {
    scene::Pen pen(font_, &quads_);
    float y = at.y0 + kAscent * style.size_px;
    for (const scene::TextLine& line : lines_) {
      const auto runs = text_.runs.span().subspan(line.first_run, line.run_count);
      const float x = leftwards(runs) ? at.x1 - em(line.width, style.size_px) : at.x0;
      pen.line(runs, x, y, style);
      y += step;
    }
  }
  return step * static_cast<float>(lines_.size());
}

// A badge with the button's sign, and beside it what it does; mirrored for leftward scripts.
float Signboard::menu_row(const Choice& choice, const SignboardInput& input, const Box& at,
                          float text_px, bool draw) {
  const float side = 1.65f * text_px, gap = 0.6f * text_px;
  const bool there = expand_text(choice.label, input);
  const bool mirrored = there && leftwards(text_.runs.span());
  Box label = at;
  (mirrored ? label.x1 : label.x0) += mirrored ? -side - gap : side + gap;
  const Palette ink = Palette::of(input.guidance->high_contrast);
  TextStyle style{.size_px = text_px, .ink = ink.label.faded(fade_.value)};
  const float height = text_block(choice.label, input, label, style, false);
  const float row = std::max(side, height);
  if (!draw) return row + 0.35f * text_px;
  label.y0 = at.y0 + 0.5f * (row - height);
  text_block(choice.label, input, label, style, true);
  const float x0 = mirrored ? at.x1 - side : at.x0, y0 = at.y0 + 0.5f * (row - side);
  scene::Pen pen(font_, &quads_);
  pen.box({x0, y0, x0 + side, y0 + side}, 0.3f * side, ink.badge.faded(fade_.value));
  const ButtonRecord& button = input.programme->buttons[choice.button - 1u];
  FixedVector<scene::ShapedGlyph, 4> sign;
  std::int32_t width = 0;
  for (const char c : input.programme->text(button.badge)) {
    if (c < '0' || c > '9') continue;  // Other signs than digits stand on the panel alone.
    const Value& digit = input.programme->values[kDigitValues + static_cast<std::size_t>(c - '0')];
    for (const scene::ShapedGlyph& g :
         input.programme->glyphs.subspan(digit.glyphs.first, digit.glyphs.count))
      (void)sign.push(g);
    width += static_cast<std::int32_t>(digit.width);
  }
  scene::Run run;
  run.glyphs = sign.span();
  run.width = width;
  style = {.size_px = 1.05f * text_px, .ink = ink.badge_text.faded(fade_.value), .weight = 1.0f};
  pen.line({&run, 1}, x0 + 0.5f * (side - em(width, style.size_px)),
           y0 + 0.5f * side + 0.36f * style.size_px, style);
  return row + 0.35f * text_px;
}

// A page of spoken words alone leaves the picture to her.
bool Signboard::is_empty(const SignboardInput& input) const {
  const Page& page = input.programme->pages[input.guidance->page];
  return page.title == kNone && page.body == kNone && page.choice_count == 0 && !has_picture(input);
}

bool Signboard::has_picture(const SignboardInput& input) const {
  const std::uint16_t p = input.guidance->picture;
  return p < input.pictures.size() && input.pictures[p].width > 0;
}

// As large as it can be in `at`, in its own proportions. Its height.
float Signboard::picture(const SignboardInput& input, const Box& at, bool draw) {
  if (!has_picture(input) || at.height() < 24.0f) return 0.0f;
  const PictureSize size = input.pictures[input.guidance->picture];
  const float scale = std::min(at.width() / size.width, at.height() / size.height);
  const float w = scale * size.width, h = scale * size.height;
  const float x = 0.5f * (at.x0 + at.x1 - w);
  if (draw) scene::Pen(font_, &quads_).picture({x, at.y0, x + w, at.y0 + h}, fade_.value);
  return h;
}

// A picture that is higher than wide stands beside the text; empty for another.
Box Signboard::picture_column(const SignboardInput& input, const CardFit& fit) const {
  if (!has_picture(input)) return {};
  const PictureSize size = input.pictures[input.guidance->picture];
  if (size.height <= size.width) return {};
  const Box& in = fit.inside;
  const float aspect = static_cast<float>(size.width) / static_cast<float>(size.height);
  const float width = std::min(kColumn * in.width(), aspect * in.height());
  return {in.x1 - width, in.y0, in.x1, in.y1};
}

// Title, picture, text and menu from above; gives the height that they need.
float Signboard::fill_card(const SignboardInput& input, const CardFit& fit, bool draw) {
  const Page& page = input.programme->pages[input.guidance->page];
  const Palette ink = Palette::of(input.guidance->high_contrast);
  const float text_px = fit.text_px, gap = kGap * text_px;
  const auto choices = input.programme->choices.subspan(page.first_choice, page.choice_count);
  const TextStyle title{
      .size_px = kTitle * text_px, .ink = ink.title.faded(fade_.value), .weight = 0.75f};
  const TextStyle body{.size_px = text_px, .ink = ink.body.faded(fade_.value)};
  const std::uint16_t body_text = fit.body ? page.body : kNone;
  Box inside = fit.inside;
  float y = inside.y0;
  const float title_height = text_block(page.title, input, inside, title, draw);
  if (title_height > 0.0f) y += title_height + 0.5f * gap;
  const Box column = picture_column(input, {{inside.x0, y, inside.x1, inside.y1}, text_px});
  if (!column.empty()) inside.x1 = column.x0 - 1.2f * text_px;
  if (!column.empty() && draw) picture(input, column, true);
  float rest = text_block(body_text, input, inside, body, false);
  if (rest > 0.0f) rest += gap;
  for (const Choice& c : choices)
    if (c.label != kNone) rest += menu_row(c, input, inside, text_px, false);
  if (has_picture(input) && column.empty()) {
    const Box at{inside.x0, y, inside.x1, inside.y1 - rest - gap};
    y += (draw ? picture(input, at, true) : kLeastPicture * text_px) + gap;
  }
  if (draw) {
    Box at{inside.x0, y, inside.x1, inside.y1};
    const float height = text_block(body_text, input, at, body, true);
    at.y0 += height > 0.0f ? height + gap : 0.0f;
    for (const Choice& c : choices)
      if (c.label != kNone) at.y0 += menu_row(c, input, at, text_px, true);
  }
  return y - inside.y0 + rest;
}

// Asleep the scene is dark; letters would still be read.
void Signboard::darken(const SignboardInput& input) {
  if (dim_.value < 0.003f) return;
  const float beyond = 0.1f * (input.width + input.height);
  scene::Pen(font_, &quads_)
      .box({-beyond, -beyond, input.width + beyond, input.height + beyond}, 1.0f,
           Ink{0, 0, 0, 255}.faded(dim_.value));
}

// The largest letters with which all fits. Where not even letters of the usual size do, the page
// goes without its body, which a button reads aloud.
Signboard::CardFit Signboard::fit_card(const SignboardInput& input, float* out_height) {
  const float usual = kUsual * layout_.text_px;
  for (const bool body : {true, false}) {
    CardFit fit;
    fit.body = body;
    for (fit.text_px = layout_.text_px; fit.text_px > usual; fit.text_px *= 0.96f) {
      fit.inside = layout_.card.inset(kPadding * fit.text_px);
      *out_height = fill_card(input, fit, false);
      if (*out_height <= fit.inside.height()) return fit;
    }
  }
  CardFit fit;
  fit.text_px = usual;
  fit.inside = layout_.card.inset(kPadding * usual);
  *out_height = fill_card(input, fit, false);
  return fit;
}

void Signboard::draw_card(const SignboardInput& input) {
  card_ = {};
  if (fade_.value < 0.02f || layout_.card.empty()) return;
  if (layout_.card.overlaps(input.head)) return;  // She is on her way: not in front of her face.
  float height = 0.0f;
  const CardFit fit = fit_card(input, &height);
  card_ = layout_.card;
  if (!has_picture(input))  // As high as it needs to be.
    card_.y1 = std::min(card_.y1, card_.y0 + height + 2.0f * kPadding * fit.text_px);
  const Palette ink = Palette::of(input.guidance->high_contrast);
  scene::Pen(font_, &quads_).box(card_, 0.7f * fit.text_px, ink.card.faded(fade_.value));
  fill_card(input, fit, true);
}

// As many lines as fit, of those the ones with the word that is heard.
void Signboard::draw_captions(const SignboardInput& input) {
  caption_ = {};
  if (input.said == nullptr || !input.guidance->captions || silence_s_ > kStay_s) return;
  const auto runs = input.said->runs.span();
  const float size = layout_.caption_px;
  const float room = layout_.caption.width() - 1.6f * size;
  scene::break_lines(runs, static_cast<std::int32_t>(room * pack::kUnitsPerEm / size), &lines_);
  if (lines_.empty()) return;
  std::size_t current = 0;
  for (std::size_t l = 0; l < lines_.size(); ++l)
    if (lines_[l].run_count > 0 && runs[lines_[l].first_run].text_begin <= input.word_byte)
      current = l;
  const auto most = static_cast<std::size_t>(layout_.caption_lines);
  const std::size_t first = current / most * most;
  const std::size_t count = std::min(most, lines_.size() - first);
  float width = 0.0f;
  for (std::size_t l = first; l < first + count; ++l)
    width = std::max(width, em(lines_[l].width, size));
  caption_ = caption_box(layout_, static_cast<int>(count), width, input.head);
  if (caption_.empty()) return;
  const Palette ink = Palette::of(input.guidance->high_contrast);
  scene::Pen pen(font_, &quads_);
  pen.box(caption_, 0.35f * size, ink.caption);
  const TextStyle style{.size_px = size,
                        .ink = ink.said,
                        .weight = 0.35f,
                        .outline = ink.outline,
                        .outline_px = 0.05f * size};
  float y = caption_.y0 + 0.55f * size + kAscent * size;
  std::array<Ink, kMaxRuns> inks;
  for (std::size_t l = first; l < first + count; ++l) {
    const scene::TextLine& line = lines_[l];
    const auto words = runs.subspan(line.first_run, line.run_count);
    for (std::size_t i = 0; i < words.size(); ++i)
      inks[i] = ink_of(words[i], input.word_byte, input.speaking, ink.said, ink.word, ink.to_come);
    const float middle = 0.5f * (caption_.x0 + caption_.x1);
    pen.line(words, middle - 0.5f * em(line.width, size), y, style,
             std::span<const Ink>(inks).first(words.size()));
    y += kLineHeight * size;
  }
}

scene::Overlay Signboard::overlay(const SignboardInput& input, float dt_s) {
  const Guidance& g = *input.guidance;
  const float dt = std::clamp(dt_s, 0.0f, 0.1f);
  silence_s_ = input.speaking ? 0.0f : silence_s_ + dt;
  give_way(input);
  const bool passing = layout_.card.overlaps(input.head);
  fade_.step(g.visited && !passing ? 1.0f : 0.0f, kFadeRate, dt);
  dim_.step(g.asleep ? kAsleep : 0.0f, kDimRate, dt);
  // What the quads depend on; while something moves they are made anew in each frame.
  const std::int32_t facts[] = {g.page,
                                g.language,
                                g.picture,
                                g.visited,
                                g.large_text,
                                g.high_contrast,
                                g.captions,
                                g.say,
                                input.speaking,
                                input.word_byte,
                                silence_s_ > kStay_s,
                                input.now.minute,
                                input.now.weekday,
                                static_cast<std::int32_t>(fade_.value * 255.0f),
                                static_cast<std::int32_t>(dim_.value * 255.0f),
                                static_cast<std::int32_t>(input.width),
                                static_cast<std::int32_t>(input.height),
                                static_cast<std::int32_t>(layout_.card.x0),
                                static_cast<std::int32_t>(layout_.card.y1),
                                layout_.card.overlaps(input.head),
                                layout_.caption.overlaps(input.head)};
  std::uint64_t key = hash_of(std::span<const std::int32_t>(facts));
  key = hash_of(std::span<const ProgrammeHeader* const>(&input.programme->header, 1), key);
  if (input.said != nullptr)
    key = hash_bytes(std::as_bytes(std::span<const char>(input.said->text.span())), key);
  const bool in_the_way = caption_.overlaps(input.head) || card_.overlaps(input.head);
  if (key != key_ || version_ == 0 || in_the_way) {
    key_ = key;
    ++version_;
    quads_.clear();
    darken(input);
    draw_card(input);
    draw_captions(input);
  }
  scene::Overlay out;
  out.quads = quads_.span();
  out.version = version_;
  out.picture = has_picture(input) ? g.picture : std::uint16_t{0xFFFF};
  out.width = input.width;
  out.height = input.height;
  out.turn_degrees = input.turn_degrees;
  return out;
}

}  // namespace caryatid::agent
