#pragma once
// Plays an FBA stream by the clock while it arrives, from a file, a pipe or a socket, in fixed
// memory: bytes go in as they come, frames come out when they are due.
#include <span>

#include "core/face/fit.h"
#include "core/stream/fba_decoder.h"

namespace caryatid::stream {

// The frames are ready for a face: FAPs that the stream's masks say to hold are present, those that
// other tools leave out are filled from their partners, and all are within the coding range of the
// FAP table. FAPs 1 and 2 are left as fields (face::expand_viseme).
//
// Late bytes, damage and the end of the stream hold the last face. A stream that jumps in time, by
// a time code or by damage, goes on one frame later.
class FbaPlayback {
 public:
  // Borrows both. `buffer` holds what has come and not been decoded: as many bytes as arrive at
  // once, and no less than kMinBufferBytes, a whole plane. `nodes`: see FbaDecoder.
  FbaPlayback(std::span<std::byte> buffer, std::span<ModelNode> nodes,
              const FbaDecoder::Options& options)
      : buffer_(buffer), decoder_(nodes, options) {}

  // Longest plane with every parameter of face and body, with room to spare.
  static constexpr std::size_t kMinBufferBytes = 4096;

  // The rules that complete its frames; borrowed. default_fit() until this is called.
  void set_fit(std::span<const face::FitRule> fit) { fit_ = fit; }

  // Takes bytes of the stream, as many as there is room for; returns how many. The rest comes again
  // after advance().
  std::size_t push(std::span<const std::byte> bytes);
  // No more bytes will come.
  void close() { closed_ = true; }

  // Decodes the planes that are due at `time_s` since the start of playing. True: a frame changed.
  bool advance(double time_s);
  // Nothing more will change.
  bool ended() const { return ended_; }
  // When the plane after the last one would be due: the end of playing, once ended().
  double next_due_s() const { return due_s_ + 1.0 / decoder_.rate().hertz(); }

  const face::FapFrame& face() const { return face_; }
  const body::BapFrame& body() const { return body_; }
  bool has_face() const { return has_face_; }
  bool has_body() const { return has_body_; }
  // The last thing that went wrong, for a log line (describe_fba_fault); ok when nothing did.
  Status last_fault() const { return last_fault_; }
  const FbaDecoder& decoder() const { return decoder_; }

 private:
  Status decode_one();
  void schedule(double time_s);

  std::span<std::byte> buffer_;
  std::size_t filled_ = 0;
  FbaDecoder decoder_;
  bool closed_ = false;
  bool ended_ = false;

  std::span<const face::FitRule> fit_ = face::default_fit();

  bool waiting_ = false;   // A decoded plane waits for its time.
  double due_s_ = 0.0;     // Of the plane that waits, or the last one.
  double stream_s_ = 0.0;  // Its time by the stream.
  bool starved_ = true;    // Bytes were missing when the last plane was looked for.
  FbaPlane plane_;
  face::FapFrame next_face_, face_;
  body::BapFrame next_body_, body_;
  bool has_face_ = false;
  bool has_body_ = false;
  Status last_fault_{};
};

}  // namespace caryatid::stream
