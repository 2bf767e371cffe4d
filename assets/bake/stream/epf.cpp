#include "assets/bake/stream/epf.h"

#include <cstdlib>
#include <map>
#include <stdexcept>

#include "assets/bake/files/files.h"

namespace caryatid::bake {
namespace {

using stream::FapMaskType;
using stream::RangeCodes;

class Parser {
 public:
  Parser(const std::string& text, const std::string& name) : text_(text), name_(name) {
    // The codec's own ranges when a file gives none: the FAP table's, rounded up to 60.
    for (int fap = 3; fap <= face::kFapCount; ++fap) {
      const face::FapInfo& info = face::fap_info(fap);
      const auto code = [](int steps) {
        return static_cast<std::uint8_t>((steps + stream::kRangeStep - 1) / stream::kRangeStep);
      };
      state_.settings.range[stream::fap_slot(fap)] = {code(info.intra_max), code(info.intra_max),
                                                      code(info.inter_max), code(info.inter_max)};
    }
    state_.face = true;
    state_.settings.plane_start_codes = false;
  }

  std::vector<EpfPlane> run() {
    std::string tag;
    while (word(&tag)) {
      if (tag == "FBM") {
        if (open_) planes_.push_back(state_);
        begin_block();
      } else {
        apply(tag);
      }
    }
    if (open_) planes_.push_back(state_);
    if (planes_.empty()) fail("no plane; begin each with FBM and its objects, 1 face, 2 body");
    return planes_;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw std::runtime_error(name_ + ":" + std::to_string(line_) + ": " + what);
  }

  bool word(std::string* out) {
    while (at_ < text_.size()) {
      if (text_[at_] == '#')
        while (at_ < text_.size() && text_[at_] != '\n') ++at_;
      else if (text_[at_] == '\n')
        ++line_, ++at_;
      else if (text_[at_] == ' ' || text_[at_] == '\t' || text_[at_] == '\r')
        ++at_;
      else
        break;
    }
    const std::size_t begin = at_;
    while (at_ < text_.size() && std::string(" \t\r\n").find(text_[at_]) == std::string::npos)
      ++at_;
    *out = text_.substr(begin, at_ - begin);
    return !out->empty();
  }

  int number(int low, int high) {
    std::string token;
    if (!word(&token)) fail("the file ends within a tag; complete it");
    char* end = nullptr;
    const long value = std::strtol(token.c_str(), &end, 10);
    if (*end != '\0' || value < low || value > high)
      fail("'" + token + "' is not a number in " + std::to_string(low) + ".." +
           std::to_string(high));
    return static_cast<int>(value);
  }
  std::uint8_t small(int low, int high) { return static_cast<std::uint8_t>(number(low, high)); }

  void begin_block() {
    state_.line = line_;
    const int objects = number(0, 3);
    state_.face = (objects & 1) != 0;
    state_.body = (objects & 2) != 0;
    state_.has_time_code = state_.has_rate = false;
    state_.skip = 0;
    state_.settings.repeat_ranges = false;
    open_ = true;
  }

  void apply(const std::string& tag) {
    static const std::map<std::string, std::uint8_t RangeCodes::*> kRanges = {
        {"IX", &RangeCodes::intra_high},
        {"IN", &RangeCodes::intra_low},
        {"PX", &RangeCodes::inter_high},
        {"PN", &RangeCodes::inter_low}};
    stream::FbaSettings& s = state_.settings;
    const bool range = tag.size() == 3 && (tag[0] == 'F' || tag[0] == 'B');
    if (const auto found = kRanges.find(tag.size() == 3 ? tag.substr(1) : "");
        range && found != kRanges.end())
      return ranges(tag[0] == 'B', found->second);
    if (tag == "ISI")
      state_.intra = number(0, 1) == 1;
    else if (tag == "FFR")
      state_.face_frame = number(0, 1 << 30);
    else if (tag == "BFR")
      state_.body_frame = number(0, 1 << 30);
    else if (tag == "FRR" || tag == "BRR")
      rate();
    else if (tag == "TC" || tag == "BTC")
      time_code();
    else if (tag == "SKN" || tag == "BSK")
      state_.skip = static_cast<std::uint32_t>(number(0, 100000));
    else if (tag == "FMT")
      face_masks();
    else if (tag == "BMT")
      body_masks();
    else if (tag == "FQU")
      s.fap_quant = small(0, 31);
    else if (tag == "BQU")
      s.bap_quant_index = small(0, 31);
    else
      fail("unknown tag '" + tag + "'; see the head of epf.h for the known ones");
  }

  void rate() {
    state_.settings.rate.frame_rate = small(1, 255);
    state_.settings.rate.sixteenths = small(0, 15);
    state_.settings.rate.by_1001 = number(0, 1) == 1;
    state_.has_rate = true;
  }

  void time_code() {
    state_.time_code.hours = small(0, 31);
    state_.time_code.minutes = small(0, 63);
    number(1, 1);  // The marker.
    state_.time_code.seconds = small(0, 63);
    state_.has_time_code = true;
  }

  void face_masks() {
    for (int group = 1; group <= face::kFapGroupCount; ++group) {
      const face::FapGroup faps = face::fap_group(group);
      const auto type = static_cast<FapMaskType>(number(0, 3));
      const bool listed = type == FapMaskType::hold || type == FapMaskType::interpolate;
      state_.settings.unlisted[static_cast<std::size_t>(group)] = type;
      for (int fap = faps.first; fap <= faps.last; ++fap)
        state_.settings.fap_mask.set(static_cast<std::size_t>(fap),
                                     listed ? number(0, 1) == 1 : type == FapMaskType::all);
    }
  }

  void body_masks() {
    for (int group = 1; group <= body::kBapGroupCount; ++group) {
      const int type = number(0, 3);
      if (type == 2) fail("body group type 2 does not exist; write 0 none, 1 mask or 3 all");
      for (const std::uint16_t bap : body::bap_group(group))
        state_.settings.bap_mask.set(bap, type == 1 ? number(0, 1) == 1 : type == 3);
    }
  }

  void ranges(bool body, std::uint8_t RangeCodes::*which) {
    const std::size_t first = body ? stream::kBapSlotBase : stream::kFieldSlots;
    const std::size_t end = body ? stream::kFbaSlots : stream::kBapSlotBase;
    for (std::size_t slot = first; slot < end; ++slot) {
      const int value = std::abs(number(-stream::kMaxRangeCode * stream::kRangeStep,
                                        stream::kMaxRangeCode * stream::kRangeStep));
      state_.settings.range[slot].*which =
          static_cast<std::uint8_t>((value + stream::kRangeStep - 1) / stream::kRangeStep);
    }
    state_.settings.repeat_ranges = true;
  }

  const std::string& text_;
  const std::string& name_;
  std::size_t at_ = 0;
  int line_ = 1;
  bool open_ = false;
  EpfPlane state_;
  std::vector<EpfPlane> planes_;
};

bool same_setup(const stream::FbaSettings& a, const stream::FbaSettings& b) {
  for (std::size_t slot = 0; slot < stream::kFbaSlots; ++slot) {
    const RangeCodes &x = a.range[slot], &y = b.range[slot];
    if (x.intra_high != y.intra_high || x.intra_low != y.intra_low ||
        x.inter_high != y.inter_high || x.inter_low != y.inter_low)
      return false;
  }
  return a.fap_quant == b.fap_quant && a.bap_quant_index == b.bap_quant_index &&
         a.fap_mask == b.fap_mask && a.bap_mask == b.bap_mask && a.unlisted == b.unlisted &&
         a.rate == b.rate;
}

}  // namespace

std::vector<EpfPlane> parse_epf(const std::string& text, const std::string& name) {
  return Parser(text, name).run();
}

std::vector<EpfPlane> read_epf(const std::string& path) { return parse_epf(read_file(path), path); }

std::vector<std::byte> encode_by_epf(const AnimationClip& clip, const std::vector<EpfPlane>& planes,
                                     const std::string& name) {
  // No plane is longer: masks and ranges of every parameter, then 24 bits for each.
  constexpr std::size_t kMaxPlaneBytes = 4096;
  std::vector<stream::ModelNode> nodes(1 << 20);
  std::vector<std::byte> bytes(64 + planes.size() * kMaxPlaneBytes);
  stream::BitWriter writer(bytes);
  stream::FbaEncoder encoder(planes.front().settings, nodes);
  const auto check = [&name](Status status, int line) {
    if (!status.ok())
      throw std::runtime_error(name + ":" + std::to_string(line) + ": " +
                               stream::describe_fba_fault(status));
  };
  check(encoder.begin(&writer), planes.front().line);
  const stream::FbaSettings* current = &planes.front().settings;
  for (const EpfPlane& plane : planes) {
    const std::string where = name + ":" + std::to_string(plane.line) + ": ";
    if (!same_setup(*current, plane.settings)) {
      if (!plane.intra)
        throw std::runtime_error(where +
                                 "masks, quantisers, rate or ranges change in a plane that "
                                 "is not intra; write ISI 1");
      check(encoder.change(plane.settings), plane.line);
    }
    current = &plane.settings;
    if (!plane.face && !plane.body) {
      writer.bits(plane.intra ? 4 : 0, 3);
      continue;
    }
    stream::FbaPlaneInput input;
    const auto face_frame = static_cast<std::size_t>(plane.face_frame);
    const auto body_frame = static_cast<std::size_t>(plane.body_frame);
    if ((plane.face && face_frame >= clip.face.size()) ||
        (plane.body && body_frame >= clip.body.size()))
      throw std::runtime_error(where + "the text has no such frame; correct FFR or BFR");
    if (plane.face) input.face = &clip.face[face_frame];
    if (plane.body) input.body = &clip.body[body_frame];
    input.intra = plane.intra;
    input.skip = plane.skip;
    input.has_time_code = plane.has_time_code;
    input.time_code = plane.time_code;
    check(encoder.encode(input, &writer), plane.line);
  }
  check(encoder.finish(&writer), planes.back().line);
  bytes.resize(writer.size_bytes());
  return bytes;
}

}  // namespace caryatid::bake
