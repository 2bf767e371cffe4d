#include "firmware-app/desk.h"

#include <cstring>

#include "core/agent/describe.h"
#include "firmware-app/builtin.h"
#include "firmware-app/pictures.h"
#include "platform/log/log.h"

namespace caryatid::app {
namespace {

using platform::Event;

void print(const Messages& messages) {
  for (const Message& m : messages.all()) platform::log(Event::text_refused, "%s", m.line.c_str());
}

// Reads the pictures that a programme names, in their order; `take` gets each that is sound.
template <class Take>
bool read_pictures(const std::string& config, const agent::Programme& programme,
                   std::uint32_t most_side, Take take) {
  ProgrammeFiles files(config, builtin_programme());
  bool all = true;
  for (std::size_t p = 0; p < programme.pictures.size(); ++p) {
    const std::string name(programme.text(programme.pictures[p].file));
    std::string bytes, error;
    Picture picture;
    if (files.read(name, kMostPictureBytes, &bytes, &error) &&
        decode_picture(bytes, most_side, &picture, &error)) {
      take(p, picture);
      continue;
    }
    all = false;
    platform::log(Event::text_refused, "%s: %s (the page is shown without it)",
                  files.full_name(name).c_str(), error.c_str());
  }
  return all;
}

}  // namespace

bool Desk::compile(ProgrammeFiles files, CompiledProgramme* out) {
  const Result<pack::FontView> font = pack::read_font(builtin_font());
  if (!font.ok()) return false;
  font_ = font.value;
  *out = compile_programme(files, font_);
  files_read_ = files.names_read();
  if (letters_.empty()) letters_ = Shaper(font_).letters();
  return !out->block.empty();
}

bool Desk::open(const std::string& config) {
  CompiledProgramme compiled;
  const bool good = compile({config, builtin_programme()}, &compiled);
  print(compiled.messages);
  config_ = config;
  compiled_ = std::move(compiled.block);
  return good;
}

bool Desk::open_notice(const std::string& config) {
  constexpr const char* kNotice = "out_of_order.toml";
  CompiledProgramme compiled;
  const ProgrammeFiles beside(config, {});
  const bool own = !config.empty() && beside.exists(kNotice);
  bool good = own && open(beside.full_name(kNotice));
  if (!good) {
    good = compile({"", builtin_programme(), kNotice}, &compiled);
    print(compiled.messages);
    config_.clear();
    compiled_ = std::move(compiled.block);
  }
  return good;
}

bool Desk::check(const std::string& config) {
  Desk desk;
  CompiledProgramme compiled;
  const bool good = desk.compile({config, builtin_programme()}, &compiled);
  print(compiled.messages);
  if (!good) return false;
  std::vector<std::uint32_t> words((compiled.block.size() + 3) / 4);
  std::memcpy(words.data(), compiled.block.data(), compiled.block.size());
  const auto programme =
      agent::read_programme(std::as_bytes(std::span(words)).first(compiled.block.size()),
                            desk.font_.header->crc, desk.font_.glyphs.size());
  const auto ignore = [](std::size_t, const Picture&) {};
  return programme.ok() && read_pictures(config, programme.value, 64, ignore) &&
         compiled.messages.all().empty();
}

bool Desk::take_memory(Arena& arena) {
  for (auto& slot : slots_)
    slot = arena.take<std::uint32_t>(kMaxProgrammeBytes / sizeof(std::uint32_t));
  if (slots_[1].empty()) return false;
  std::memcpy(slots_[0].data(), compiled_.data(), compiled_.size());
  const auto programme = agent::read_programme(std::as_bytes(slots_[0]).first(compiled_.size()),
                                               font_.header->crc, font_.glyphs.size());
  compiled_ = {};
  if (programme.ok()) guide_.take(programme.value);
  if (programme.ok()) remember_start();
  if (!config_.empty()) reload_.watch(config_, files_read_);
  return programme.ok();
}

void Desk::load(platform::Renderer& renderer, std::uint32_t most_side) {
  std::uint32_t side = 256;
  while (side < most_side && side < 1024) side *= 2;
  (void)renderer.load_font(font_);
  start_pictures_.clear();
  for (const agent::PictureRecord& p : programme().pictures) {
    picture_then_[start_pictures_.size()] = static_cast<std::uint16_t>(start_pictures_.size());
    (void)start_pictures_.push({FixedString<95>(programme().text(p.file)), {}});
  }
  (void)read_pictures(config_, programme(), side, [&](std::size_t p, const Picture& picture) {
    if (renderer
            .load_picture(static_cast<std::uint16_t>(p), picture.texture_width,
                          picture.texture_height, picture.texels)
            .ok())
      start_pictures_[p].size = pictures_[p] = {picture.width, picture.height};
  });
  signboard_.start(font_);
}

void Desk::reload(std::int64_t now_us, bool speaking) {
  const auto other = std::as_writable_bytes(slots_[1 - slot_]);
  if (new_bytes_ == 0) {
    switch (reload_.poll(now_us, other, &new_bytes_)) {
      case Reload::State::quiet:
        new_bytes_ = 0;
        break;
      case Reload::State::failed:
        new_bytes_ = 0;
        platform::log(Event::text_refused, "the changed texts are not used; the old ones go on");
        break;
      case Reload::State::ready:
        break;
    }
  }
  if (new_bytes_ > 0 && !speaking) adopt();
}

void Desk::remember_start() {
  for (const agent::ButtonRecord& b : programme().buttons) {
    (void)start_buttons_.push(FixedString<31>(programme().text(b.name)));
    button_now_[start_buttons_.size() - 1] = static_cast<std::uint16_t>(start_buttons_.size());
  }
}

// Buttons belong to devices, which were opened at start; they keep their numbers.
void Desk::match_buttons(const agent::Programme& next) {
  button_now_ = {};
  for (std::size_t b = 0; b < next.buttons.size(); ++b) {
    const std::string_view name = next.text(next.buttons[b].name);
    bool known = false;
    for (std::size_t s = 0; s < start_buttons_.size(); ++s) {
      if (name != std::string_view(start_buttons_[s].c_str(), start_buttons_[s].size())) continue;
      button_now_[s] = static_cast<std::uint16_t>(b + 1);
      known = true;
    }
    if (!known)
      platform::log(Event::text_refused, "button '%.*s' is new; start again to press it",
                    static_cast<int>(name.size()), name.data());
  }
}

// Pictures are in the GPU since start.
void Desk::match_pictures(const agent::Programme& next) {
  pictures_ = {};
  for (std::size_t p = 0; p < next.pictures.size(); ++p) {
    const std::string_view file = next.text(next.pictures[p].file);
    bool known = false;
    for (std::size_t s = 0; s < start_pictures_.size(); ++s) {
      const StartPicture& old = start_pictures_[s];
      if (file != std::string_view(old.file.c_str(), old.file.size())) continue;
      pictures_[p] = old.size;
      picture_then_[p] = static_cast<std::uint16_t>(s);
      known = true;
    }
    if (!known)
      platform::log(Event::text_refused, "%.*s: is a new picture; start again to see it",
                    static_cast<int>(file.size()), file.data());
  }
}

void Desk::adopt() {
  const auto block = std::as_bytes(slots_[1 - slot_]).first(new_bytes_);
  new_bytes_ = 0;
  const auto next = agent::read_programme(block, font_.header->crc, font_.glyphs.size());
  if (!next.ok()) {
    platform::log(Event::text_refused, "%s; the old texts go on",
                  agent::refusal_text(static_cast<agent::ProgrammeRefusal>(next.status.detail)));
    return;
  }
  match_buttons(next.value);
  match_pictures(next.value);
  said_.clear();  // Its letters lie in the old block.
  plain_ = {};
  mute_ = {};
  guide_.take(next.value);
  slot_ = 1 - slot_;
  platform::log(Event::text_taken, "changed texts taken over");
}

void Desk::complete(agent::SignboardInput* io_frame) const {
  io_frame->programme = &programme();
  io_frame->guidance = &guide_.guidance();
  io_frame->said = said_.text.empty() ? nullptr : &said_;
  io_frame->now = now_;
  io_frame->pictures = pictures_;
}

const scene::Box& Desk::stage(agent::SignboardInput frame, float dt_s) {
  complete(&frame);
  return signboard_.stage(frame, dt_s);
}

scene::Overlay Desk::overlay(agent::SignboardInput frame, float dt_s) {
  complete(&frame);
  scene::Overlay out = signboard_.overlay(frame, dt_s);
  if (out.picture < kMaxPictures) out.picture = picture_then_[out.picture];
  return out;
}

const agent::Guidance& Desk::step(float dt_s, std::span<const ButtonEvent> events,
                                  const agent::Moment& now, bool speaking) {
  now_ = now;
  // From the numbers that devices know to those of the present programme.
  platform::ButtonEvents mine;
  for (ButtonEvent e : events) {
    e.button = e.button >= 1 && e.button <= kMaxButtons ? button_now_[e.button - 1u] : 0;
    if (e.button != 0) (void)mine.push(e);
  }
  const agent::Guidance& g = guide_.step(dt_s, mine.span(), now, speaking);
  if (g.describes || g.says) {
    described_ = g.describes;
    write_said();
  }
  return g;
}

// In the visitor's language, or the next one that the voice knows; where it knows none, in the
// visitor's own.
void Desk::write_said() {
  agent::Guidance g = guide_.guidance();
  const auto count = static_cast<std::uint16_t>(programme().languages.size());
  const std::uint16_t own = g.language;
  for (std::uint16_t i = 0; i < count; ++i) {
    g.language = static_cast<std::uint16_t>((own + i) % count);
    if (!mute_[g.language]) break;
    if (i + 1 == count) g.language = own;
  }
  const agent::Line* line = programme().line(g.say, g.language);
  if (described_)
    agent::describe(programme(), g, now_, &said_);
  else if (line != nullptr)
    agent::expand(programme(), *line, now_, &said_);
  else
    return;
  plain_ = {};
  ssml_.write(programme(), said_);
}

bool Desk::say_in_next_language() {
  if (!plain_.empty() || said_.text.empty()) return false;
  const std::uint16_t unknown = said_.language;
  mute_[unknown] = true;
  write_said();
  return said_.language != unknown && !mute_[said_.language];
}

void Desk::caption(std::string_view text) {
  plain_ = text;
  set_from_ = 0;
  set_to_ = agent::TypeCase(letters_).set(plain_, 0, &said_);
}

std::int32_t Desk::caption_byte(std::uint32_t spoken_byte) {
  if (plain_.empty()) return static_cast<std::int32_t>(ssml_.plain_byte(spoken_byte));
  if (spoken_byte >= set_to_ && spoken_byte < plain_.size()) {
    set_from_ = spoken_byte;
    set_to_ = agent::TypeCase(letters_).set(plain_, set_from_, &said_);
  }
  return static_cast<std::int32_t>(spoken_byte - set_from_);
}

std::string_view Desk::voice() const {
  return programme().text(programme().languages[said_.language].voice);
}

}  // namespace caryatid::app
