#include "firmware-app/texts/builder.h"

#include <cstring>

#include "core/base/crc.h"

namespace caryatid::app {
namespace {

template <class T>
agent::Ref append(std::vector<T>* io_all, const std::vector<T>& more) {
  const agent::Ref ref{static_cast<std::uint32_t>(io_all->size()),
                       static_cast<std::uint32_t>(more.size())};
  io_all->insert(io_all->end(), more.begin(), more.end());
  return ref;
}

// Appends a section, 4-byte aligned, and notes where it lies.
template <class Items>
void add_section(agent::ProgrammeSection id, const Items& items, std::vector<std::byte>* io_block,
                 agent::ProgrammeHeader* io_header) {
  using Item = typename Items::value_type;
  io_header->section[static_cast<std::size_t>(id)] = {static_cast<std::uint32_t>(io_block->size()),
                                                      static_cast<std::uint32_t>(items.size())};
  const auto* first = reinterpret_cast<const std::byte*>(items.data());
  io_block->insert(io_block->end(), first, first + items.size() * sizeof(Item));
  io_block->resize((io_block->size() + 3) / 4 * 4);
}

}  // namespace

agent::Ref ProgrammeBuilder::bytes(std::string_view text) {
  const auto found = known_.find(text);
  if (found != known_.end()) return found->second;
  const agent::Ref ref{static_cast<std::uint32_t>(bytes_.size()),
                       static_cast<std::uint32_t>(text.size())};
  bytes_ += text;
  known_.emplace(text, ref);
  return ref;
}

agent::Line ProgrammeBuilder::line(const ParsedText& text, const ShapedText& shaped,
                                   std::uint16_t language) {
  agent::Line out;
  out.plain = bytes(text.plain);
  std::vector<agent::Segment> segments = shaped.segments;
  for (agent::Segment& s : segments) s.first_glyph += static_cast<std::uint32_t>(glyphs_.size());
  append(&glyphs_, shaped.glyphs);
  out.segments = append(&segments_, segments);
  out.cues = append(&cues_, text.cues);
  out.language = language;
  out.is_there = 1;
  return out;
}

agent::Value ProgrammeBuilder::value(std::string_view text, const ShapedText& shaped) {
  agent::Value out;
  out.text = bytes(text);
  std::vector<scene::Run> runs(shaped.segments.size());
  for (std::size_t s = 0; s < runs.size(); ++s) runs[s].level = shaped.segments[s].level;
  std::vector<std::uint16_t> order(runs.size());
  scene::visual_order(runs, order);
  out.glyphs.first = static_cast<std::uint32_t>(glyphs_.size());
  for (const std::uint16_t i : order) {
    const agent::Segment& s = shaped.segments[i];
    for (std::uint32_t g = 0; g < s.glyph_count; ++g)
      glyphs_.push_back(shaped.glyphs[s.first_glyph + g]);
    out.width += s.width;
  }
  out.glyphs.count = static_cast<std::uint32_t>(glyphs_.size()) - out.glyphs.first;
  return out;
}

std::vector<std::byte> ProgrammeBuilder::write(std::uint32_t font_crc) const {
  agent::ProgrammeHeader header{};
  std::memcpy(header.magic, agent::kProgrammeMagic, sizeof header.magic);
  header.version = agent::kProgrammeVersion;
  header.font_crc = font_crc;
  header.text_count = text_count;
  header.start_page = start_page;
  header.always_shown = always_shown ? 1 : 0;
  header.schedule = schedule;
  header.attract = attract;
  std::vector<std::byte> block(sizeof header);
  using Id = agent::ProgrammeSection;
  add_section(Id::bytes, bytes_, &block, &header);
  add_section(Id::languages, languages, &block, &header);
  add_section(Id::buttons, buttons, &block, &header);
  add_section(Id::pages, pages, &block, &header);
  add_section(Id::choices, choices, &block, &header);
  add_section(Id::pictures, pictures, &block, &header);
  add_section(Id::lines, lines, &block, &header);
  add_section(Id::segments, segments_, &block, &header);
  add_section(Id::glyphs, glyphs_, &block, &header);
  add_section(Id::cues, cues_, &block, &header);
  add_section(Id::values, values, &block, &header);
  header.bytes = static_cast<std::uint32_t>(block.size());
  std::memcpy(block.data(), &header, sizeof header);
  header.crc = crc32c(std::span(block).subspan(agent::kProgrammeCrcStart));
  std::memcpy(block.data(), &header, sizeof header);
  return block;
}

}  // namespace caryatid::app
