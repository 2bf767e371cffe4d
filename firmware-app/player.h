#pragma once
// --play: a .fap or .bap text file of any tool, or an .fba stream, played at its own frame rate in
// place of the programme.
#include <memory>
#include <string>

#include "core/body/bap.h"
#include "core/face/fap.h"
#include "core/stream/bap_text.h"
#include "core/stream/fap_text.h"
#include "firmware-app/stream_file.h"

namespace caryatid::app {

class Player {
 public:
  // Text: reads the whole file and checks every frame before anything is shown. Streams (.fba, a
  // named pipe, "-"): see StreamFile. False: one line
  // "FILE:LINE: what; cure".
  bool open(const std::string& path, std::string* out_error);
  bool active() const { return size_ > 0 || stream_.active(); }

  // --control's play: an .fba in place of what plays now, from `time_s` on. Needs reserve() before
  // memory is sealed, then allocates nothing. False: no stream there; what played goes on.
  void reserve() { stream_.reserve(); }
  bool play_stream(std::string_view path, double time_s) { return stream_.reopen(path, time_s); }
  void stop_stream() { stream_.close(); }

  // How the person completes frames that leave FAPs out (agent::Person::fit); borrowed.
  void set_fit(std::span<const face::FitRule> fit) {
    fit_ = fit;
    stream_.set_fit(fit);
  }

  // Advances to `time_s` since the start; starts over after the last frame. No allocation.
  void seek(double time_s);
  // The frames to show; nullptr when the file has nothing (yet) of the kind.
  const face::FapFrame* faps() const { return has_face_ ? &faps_ : nullptr; }
  const body::BapFrame* baps() const {
    if (stream_.active()) return stream_.baps();
    return is_body_ ? &baps_ : nullptr;
  }
  double fps() const { return fps_; }
  std::uint32_t frame_count() const { return frame_count_; }

 private:
  template <class Reader, class Frame>
  bool check(Reader reader, Frame frame, std::string* out_error);
  template <class Reader, class Frame>
  void advance(std::uint32_t frame, Reader* reader, Frame* out);
  void expand(const face::FapFrame& raw);
  std::span<const char> text() const { return {text_.get(), size_}; }

  std::string name_;
  std::unique_ptr<char[]> text_;
  std::size_t size_ = 0;
  bool is_body_ = false;
  bool has_face_ = false;
  StreamFile stream_;
  std::span<const face::FitRule> fit_ = face::default_fit();
  double fps_ = 25.0;
  std::uint32_t frame_count_ = 0, next_frame_ = 0;
  stream::FapTextReader fap_reader_{{}};
  stream::BapTextReader bap_reader_{{}};
  face::FapFrame raw_faps_, faps_;
  body::BapFrame baps_;
};

}  // namespace caryatid::app
