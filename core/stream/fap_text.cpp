#include "core/stream/fap_text.h"

namespace caryatid::stream {
namespace {

// Greta writes 69 flags; the last one is never used.
constexpr TextLayout kFapLayout = {{68, 69, 0, 0}, true};

bool field(float value, int largest, std::uint8_t* out) {
  if (!(value >= 0.0f && value <= static_cast<float>(largest))) return false;
  *out = static_cast<std::uint8_t>(value + 0.5f);
  return true;
}

bool flag(float value, bool* out) {
  *out = value != 0.0f;
  return value == 0.0f || value == 1.0f;
}

bool read_viseme(std::span<const float> v, face::VisemeField* out) {
  if (v.size() == 1) {
    out->blend = 63;
    return field(v[0], 14, &out->first);
  }
  return field(v[0], 14, &out->first) && field(v[1], 14, &out->second) &&
         field(v[2], 63, &out->blend) && flag(v[3], &out->viseme_def);
}

bool read_expression(std::span<const float> v, face::ExpressionField* out) {
  if (v.size() == 1) {
    out->first_intensity = 63;
    return field(v[0], 6, &out->first);
  }
  return field(v[0], 6, &out->first) && field(v[1], 63, &out->first_intensity) &&
         field(v[2], 6, &out->second) && field(v[3], 63, &out->second_intensity) &&
         flag(v[4], &out->init_face) && flag(v[5], &out->expression_def);
}

constexpr Status fault(TextFault f) { return {Code::corrupt_data, static_cast<std::uint16_t>(f)}; }

}  // namespace

FapTextReader::FapTextReader(std::span<const char> text, bool complete)
    : reader_(kFapLayout, text, complete) {}

Status FapTextReader::read_fields(face::FapFrame* out, std::size_t* out_used) const {
  const bool expanded = frame_.value_count > frame_.mask.count();
  const std::span<const float> values(frame_.values);
  std::size_t used = 0;
  if (frame_.mask.test(face::kFapViseme)) {
    const std::size_t count = expanded ? 4 : 1;
    out->viseme = {};
    if (!read_viseme(values.subspan(used, count), &out->viseme))
      return fault(TextFault::viseme_field);
    used += count;
  }
  if (frame_.mask.test(face::kFapExpression)) {
    const std::size_t count = expanded ? 6 : 1;
    out->expression = {};
    if (!read_expression(values.subspan(used, count), &out->expression))
      return fault(TextFault::expression_field);
    used += count;
  }
  *out_used = used;
  return {};
}

Status FapTextReader::next(face::FapFrame* io_frame) {
  CARYATID_TRY(reader_.next(&frame_));
  face::FapFrame fields = *io_frame;
  std::size_t used = 0;
  CARYATID_TRY(read_fields(&fields, &used));
  fields.mask.clear();
  for (int fap = 1; fap <= face::kFapCount; ++fap) {
    const auto n = static_cast<std::size_t>(fap);
    if (!frame_.mask.test(n)) continue;
    fields.mask.set(n);
    if (fap > face::kFapExpression) fields.value[n] = frame_.values[used++];
  }
  *io_frame = fields;
  return {};
}

Result<std::size_t> write_fap_text(std::int32_t index, const face::FapFrame& frame,
                                   std::span<char> out) {
  TextSink sink(out);
  for (std::size_t fap = 1; fap <= face::kFapCount; ++fap) {
    if (fap > 1) sink.put(' ');
    sink.put(frame.mask.test(fap) ? '1' : '0');
  }
  sink.put('\n');
  sink.put_integer(index);
  const auto number = [&sink](int value) {
    sink.put(' ');
    sink.put_integer(value);
  };
  if (frame.has(face::kFapViseme)) {
    const face::VisemeField& v = frame.viseme;
    for (const int value : {int{v.first}, int{v.second}, int{v.blend}, int{v.viseme_def}})
      number(value);
  }
  if (frame.has(face::kFapExpression)) {
    const face::ExpressionField& e = frame.expression;
    for (const int value : {int{e.first}, int{e.first_intensity}, int{e.second},
                            int{e.second_intensity}, int{e.init_face}, int{e.expression_def}})
      number(value);
  }
  for (int fap = face::kFapExpression + 1; fap <= face::kFapCount; ++fap) {
    if (!frame.has(fap)) continue;
    sink.put(' ');
    sink.put_number(frame.get(fap));
  }
  sink.put('\n');
  if (!sink.ok())
    return {{Code::out_of_capacity, static_cast<std::uint16_t>(TextFault::out_of_room)}, 0};
  return {{}, sink.size()};
}

}  // namespace caryatid::stream
