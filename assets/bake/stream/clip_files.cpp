#include "assets/bake/stream/clip_files.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>
#include <stdexcept>

#include "assets/bake/files/files.h"
#include "core/face/fap_fill.h"
#include "core/stream/bap_text.h"
#include "core/stream/fap_text.h"

namespace caryatid::bake {
namespace {

// Enough for every symbol of every model: the tool decodes whatever the format allows.
constexpr std::size_t kNodes = 1 << 20;

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

// What a header or the frames' numbers promise and the frames do not hold; the frames count.
// Numbers from 0 or 1 on are usual.
class NumberCheck {
 public:
  NumberCheck(const std::string& path, std::vector<std::string>* out) : path_(path), out_(out) {}
  void frame(std::int32_t number, std::uint32_t line) {
    const bool follows = count_ == 0 ? number == 0 || number == 1 : number == last_ + 1;
    if (!follows && !said_)
      note(line, "frame " + std::to_string(count_ + 1) + " is numbered " + std::to_string(number) +
                     (count_ == 0 ? "" : " behind " + std::to_string(last_)) +
                     "; frames are taken in the order of the file");
    said_ = said_ || !follows;
    last_ = number;
    ++count_;
  }
  void end(std::uint32_t promised) {
    if (promised != count_)
      note(1, "the header promises " + std::to_string(promised) + " frames, the file holds " +
                  std::to_string(count_) + "; correct its last word");
  }

 private:
  void note(std::uint32_t line, const std::string& what) {
    if (out_) out_->push_back(path_ + ":" + std::to_string(line) + ": " + what);
  }
  const std::string& path_;
  std::vector<std::string>* out_;
  std::int64_t last_ = 0;
  std::uint32_t count_ = 0;
  bool said_ = false;
};

template <class Reader, class Frame>
double read_frames(const std::string& path, std::vector<Frame>* out,
                   std::vector<std::string>* out_notes) {
  const std::string text = read_file(path);
  Reader reader(text);
  Frame frame;
  auto seen = frame.mask;
  Status status;
  NumberCheck check(path, out_notes);
  while ((status = reader.next(&frame)).ok()) {
    check.frame(reader.frame_index(), reader.line());
    for (std::size_t n = 1; n < frame.value.size(); ++n)
      if (frame.mask.test(n)) seen.set(n);
    Frame whole = frame;
    whole.mask = seen;
    out->push_back(whole);
  }
  if (status.detail != static_cast<std::uint16_t>(stream::TextFault::end_of_text))
    throw std::runtime_error(path + ":" + std::to_string(reader.line()) + ": " +
                             stream::describe_text_fault(status));
  if (out->empty()) throw std::runtime_error(path + ": no frame in it; write at least one");
  check.end(reader.header().frame_count);
  return static_cast<double>(reader.header().frames_per_second);
}

template <class Frame>
std::vector<Frame> resampled(const std::vector<Frame>& frames, double from, double to) {
  std::vector<Frame> out;
  const auto count =
      static_cast<std::size_t>(std::lround(static_cast<double>(frames.size()) * to / from));
  for (std::size_t i = 0; i < count; ++i) {
    const auto at = static_cast<std::size_t>(static_cast<double>(i) * from / to + 1e-6);
    out.push_back(frames[std::min(at, frames.size() - 1)]);
  }
  return out;
}

template <class Frame, class Write>
void write_text(const std::vector<Frame>& frames, const std::string& path, const char* version,
                double frames_per_second, std::size_t longest, Write write) {
  stream::TextHeader header;
  header.version.assign({version, 3});
  const std::string name = path.substr(path.find_last_of('/') + 1);
  header.name.assign(name);
  header.frames_per_second = static_cast<float>(frames_per_second);
  header.frame_count = static_cast<std::uint32_t>(frames.size());
  std::vector<char> line(longest);
  std::string text(line.data(), stream::write_text_header(header, line).value);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const auto written = write(static_cast<std::int32_t>(i), frames[i], line);
    text.append(line.data(), written.value);
  }
  write_file(path, text);
}

}  // namespace

void resample(double frames_per_second, AnimationClip* io_clip) {
  if (!io_clip->face.empty())
    io_clip->face = resampled(io_clip->face, io_clip->frames_per_second, frames_per_second);
  if (!io_clip->body.empty())
    io_clip->body = resampled(io_clip->body, io_clip->frames_per_second, frames_per_second);
  io_clip->frames_per_second = frames_per_second;
}

void read_text(const std::string& path, AnimationClip* io_clip,
               std::vector<std::string>* out_notes) {
  AnimationClip read;
  const bool is_face = ends_with(path, ".fap");
  if (!is_face && !ends_with(path, ".bap"))
    throw std::runtime_error(path + ": not a .fap or .bap; give animation text");
  read.frames_per_second =
      is_face ? read_frames<stream::FapTextReader, face::FapFrame>(path, &read.face, out_notes)
              : read_frames<stream::BapTextReader, body::BapFrame>(path, &read.body, out_notes);
  if (io_clip->size() == 0) {
    *io_clip = std::move(read);
    return;
  }
  if (read.frames_per_second != io_clip->frames_per_second)
    resample(io_clip->frames_per_second, &read);
  if (is_face)
    io_clip->face = std::move(read.face);
  else
    io_clip->body = std::move(read.body);
}

void write_fap(const AnimationClip& clip, const std::string& path) {
  write_text(clip.face, path, "2.1", clip.frames_per_second, stream::kMaxFapTextFrameBytes,
             [](std::int32_t i, const face::FapFrame& frame, std::span<char> out) {
               return stream::write_fap_text(i, frame, out);
             });
}

void write_bap(const AnimationClip& clip, const std::string& path) {
  write_text(clip.body, path, "3.1", clip.frames_per_second, stream::kMaxBapTextFrameBytes,
             [](std::int32_t i, const body::BapFrame& frame, std::span<char> out) {
               return stream::write_bap_text(i, frame, out);
             });
}

AnimationClip read_fba(const std::string& path, const stream::FbaDecoder::Options& options,
                       FbaReport* out_report) {
  const std::string text = read_file(path);
  std::vector<stream::ModelNode> nodes(kNodes);
  stream::FbaDecoder decoder(nodes, options);
  decoder.refill(std::as_bytes(std::span(text)), true);
  AnimationClip clip;
  FbaReport report;
  report.bytes = text.size();
  stream::FbaPlane plane;
  face::FapFrame face;
  body::BapFrame body;
  bool has_face = false, has_body = false;
  std::optional<std::size_t> lost_from;  // The byte where damage began.
  const auto say_lost = [&](std::size_t to, const std::string& then) {
    report.faults.push_back("bytes " + std::to_string(*lost_from) + " to " + std::to_string(to) +
                            " of " + std::to_string(text.size()) + " are lost; " + then);
    lost_from.reset();
  };
  while (true) {
    const std::size_t position = decoder.position_bits();
    const Status status = decoder.next(&plane, &face, &body);
    if (!status.ok()) {
      if (status.code == Code::not_ready) break;
      if (!lost_from) lost_from = position / 8;
      report.faults.push_back("bit " + std::to_string(position) + ": " +
                              stream::describe_fba_fault(status));
      continue;
    }
    if (lost_from)
      say_lost(decoder.position_bits() / 8,
               "decoding goes on there, after " + std::to_string(report.planes) + " planes");
    ++report.planes;
    report.intra_planes += plane.intra ? 1u : 0u;
    has_face = has_face || plane.face;
    has_body = has_body || plane.body;
    // A plane stands for itself and for the frames that it says to skip.
    for (std::uint32_t i = 0; i <= std::min(plane.skip, 1000u); ++i) {
      if (has_face) clip.face.push_back(face);
      if (has_body) clip.body.push_back(body);
    }
  }
  if (lost_from)
    say_lost(text.size(), "that is the rest, after " + std::to_string(report.planes) + " planes");
  report.damaged_planes = decoder.damaged_planes();
  report.rate = decoder.rate();
  report.coding = decoder.coding();
  clip.frames_per_second = decoder.rate().hertz();
  report.seconds = static_cast<double>(clip.size()) / clip.frames_per_second;
  *out_report = report;
  return clip;
}

std::vector<std::byte> encode_fba(const AnimationClip& clip, std::size_t intra_every,
                                  const stream::FbaSettings& settings) {
  std::vector<stream::ModelNode> nodes(kNodes);
  const auto bits = stream::measure_bits(clip.view(intra_every), settings, nodes);
  if (!bits.ok()) throw std::runtime_error(stream::describe_fba_fault(bits.status));
  std::vector<std::byte> bytes((bits.value + 7) / 8);
  stream::BitWriter writer(bytes);
  stream::FbaEncoder encoder(settings, nodes);
  Status status = encoder.begin(&writer);
  for (std::size_t i = 0; i < clip.size() && status.ok(); ++i) {
    stream::FbaPlaneInput plane;
    if (i < clip.face.size()) plane.face = &clip.face[i];
    if (i < clip.body.size()) plane.body = &clip.body[i];
    plane.intra = intra_every > 0 && i % intra_every == 0;
    status = encoder.encode(plane, &writer);
  }
  if (status.ok()) status = encoder.finish(&writer);
  if (!status.ok()) throw std::runtime_error(stream::describe_fba_fault(status));
  return bytes;
}

stream::FbaRate rate_of(double frames_per_second) {
  const auto fields = [](double hertz, bool by_1001) {
    const long sixteenths = std::clamp(std::lround(hertz * 16.0), 1L, 255L * 16 + 15);
    return stream::FbaRate{static_cast<std::uint8_t>(sixteenths / 16),
                           static_cast<std::uint8_t>(sixteenths % 16), by_1001};
  };
  const stream::FbaRate plain = fields(frames_per_second, false);
  const stream::FbaRate slow = fields(frames_per_second * 1.001, true);
  return std::abs(slow.hertz() - frames_per_second) + 1e-9 <
                 std::abs(plain.hertz() - frames_per_second)
             ? slow
             : plain;
}

PointError summary_of(std::vector<double> errors_mm) {
  if (errors_mm.empty()) return {};
  std::sort(errors_mm.begin(), errors_mm.end());
  double sum = 0.0;
  for (const double e : errors_mm) sum += e;
  return {sum / static_cast<double>(errors_mm.size()), errors_mm[errors_mm.size() * 99 / 100],
          errors_mm.back()};
}

PointError point_error(const std::vector<face::FapFrame>& original,
                       const std::vector<face::FapFrame>& decoded) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < std::min(original.size(), decoded.size()); ++i) {
    face::FapFrame want = original[i], got = decoded[i];
    face::fill_from_partners(&want);
    face::fill_from_partners(&got);
    const auto lack_mm = [&](int fap) {
      return want.has(fap)
                 ? static_cast<double>((want.get(fap) - got.get(fap)) * stream::fap_unit_mm(fap))
                 : 0.0;
    };
    double head = 0.0;
    for (int fap = 48; fap <= 50; ++fap) head += lack_mm(fap) * lack_mm(fap);
    // Several FAPs move one point; in different directions, as a rule.
    std::map<std::pair<int, int>, double> square_mm;
    for (int fap = 3; fap <= face::kFapCount; ++fap) {
      if (!want.has(fap) || (fap >= 48 && fap <= 50)) continue;
      const face::FeaturePoint point = face::fap_info(fap).point;
      square_mm[{point.group, point.index}] += lack_mm(fap) * lack_mm(fap);
    }
    for (const auto& [point, square] : square_mm) errors.push_back(std::sqrt(square + head));
  }
  return summary_of(std::move(errors));
}

}  // namespace caryatid::bake
