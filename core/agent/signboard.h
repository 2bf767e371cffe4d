#pragma once
// Everything that is shown beside the person: the page's card (title, text, picture, menu) and the
// captions, word by word with the voice. Writes the overlay of the draw list.
#include "core/agent/guide.h"
#include "core/agent/layout.h"
#include "core/agent/stage.h"

namespace caryatid::agent {

// Pixels of the pictures that could be loaded, by index in the programme; 0: none.
struct PictureSize {
  std::uint16_t width = 0, height = 0;
};

struct SignboardInput {
  const Programme* programme = nullptr;  // Required, and the guidance that belongs to it.
  const Guidance* guidance = nullptr;    // Required.
  const Utterable* said = nullptr;       // The text of the captions; nullptr: none was said yet.
  bool speaking = false;                 // It is being said.
  std::int32_t word_byte = -1;           // First byte of the word that is heard; -1: none yet.
  Moment now;
  float width = 800, height = 480;  // Of the picture as the visitor sees it, pixels.
  scene::Box head;                  // Where the head is on it; never covered.
  float closeness = 1.0f;  // Of the camera: 0 sees the whole body and her walk, 1 her head.
  std::span<const PictureSize> pictures;
  std::uint32_t turn_degrees = 0;
};

class Signboard {
 public:
  // The font is borrowed.
  void start(const pack::FontView& font) { font_ = font; }

  // Where the camera should put the person; moves softly. Pixels. Before the camera is aimed.
  const scene::Box& stage(const SignboardInput& input, float dt_s);
  // What to draw, rebuilt when something changed. O(letters) then, O(1) else.
  scene::Overlay overlay(const SignboardInput& input, float dt_s);

  // The card stands left of her, as the visitor sees it.
  bool mirrored() const { return mirrored_; }
  // Where card and captions were drawn last; empty when they were not.
  const scene::Box& card() const { return card_; }
  const scene::Box& caption() const { return caption_; }

 private:
  struct Palette;
  struct Key;
  static constexpr float kStay_s = 2.5f;  // Captions after the last word.

  Layout layout(const SignboardInput& input) const;
  void give_way(const SignboardInput& input);
  void draw_card(const SignboardInput& input);
  struct CardFit {
    scene::Box inside;
    float text_px = 20.0f;
    bool body = true;
  };
  float fill_card(const SignboardInput& input, const CardFit& fit, bool draw);
  CardFit fit_card(const SignboardInput& input, float* out_height);
  scene::Box picture_column(const SignboardInput& input, const CardFit& fit) const;
  float text_block(std::uint16_t text, const SignboardInput& input, const scene::Box& at,
                   const scene::TextStyle& style, bool draw);
  float menu_row(const Choice& choice, const SignboardInput& input, const scene::Box& at,
                 float text_px, bool draw);
  float picture(const SignboardInput& input, const scene::Box& at, bool draw);
  bool has_picture(const SignboardInput& input) const;
  bool is_empty(const SignboardInput& input) const;
  void draw_captions(const SignboardInput& input);
  void darken(const SignboardInput& input);
  bool expand_text(std::uint16_t text, const SignboardInput& input);

  pack::FontView font_;
  Layout layout_;
  scene::Box stage_, card_, caption_;
  Follower edge_[4];  // Of the stage: x0, y0, x1, y1.
  Follower fade_;     // Of the card.
  Follower dim_;
  float silence_s_ = 1e6f;
  bool placed_ = false;
  bool mirrored_ = false;
  std::uint64_t key_ = 0;
  std::uint32_t version_ = 0;
  Utterable text_;  // Scratch.
  scene::TextLines lines_;
  FixedVector<scene::OverlayQuad, kMaxOverlayQuads> quads_;
};

}  // namespace caryatid::agent
