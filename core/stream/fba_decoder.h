#pragma once
// Decodes FBA elementary streams in predictive mode, face and body, plane by plane.
#include <array>
#include <span>

#include "core/body/bap.h"
#include "core/face/fap.h"
#include "core/stream/fba.h"

namespace caryatid::stream {

// Planes of a stream that is borrowed, whole or piece by piece:
//
//   FbaDecoder decoder(nodes, {});
//   decoder.refill(bytes, true);
//   while (true) {
//     const Status status = decoder.next(&plane, &face, &body);
//     if (status.ok()) show(face, body);
//     else if (status.code == Code::not_ready) break;  // end_of_stream or need_more
//     // any other: the faces hold; the next call looks for the next intra plane
//   }
//
// Damage: a plane that does not decode is reported once, and changes nothing. The following calls
// search for the next intra plane: behind a start code, or, between the bits, one that repeats the
// known masks and quantisers or brings all its ranges with it.
// Memory: the object (about 15 KB) and the caller's nodes, see AdaptiveModel: 16384 nodes (128 KiB)
// are plenty for streams with an intra plane in every minute.
// Cost: O(parameters x symbols seen) a plane. Not thread-safe; no global state.
class FbaDecoder {
 public:
  struct Options {
    // Nothing in a stream tells which base steps its body was coded with.
    body::BapQuantisers quantisers = body::BapQuantisers::visage;
  };

  // Borrows `nodes`.
  FbaDecoder(std::span<ModelNode> nodes, const Options& options)
      : options_(options), pool_(nodes) {}
  FbaDecoder(const FbaDecoder&) = delete;
  FbaDecoder& operator=(const FbaDecoder&) = delete;

  // Goes on with bytes that start at the first one not yet consumed_bytes().
  void refill(std::span<const std::byte> bytes, bool complete);
  std::size_t consumed_bytes() const { return position_ / 8; }
  // Bits since the first byte of the stream.
  std::size_t position_bits() const { return before_ * 8 + position_; }

  // Decodes one plane. Sets the masks of the objects that the plane has to the parameters in the
  // stream, and their values; parameters and objects that are not there keep what they held. A
  // plane with neither object means: all as before. Values may exceed the ranges of the FAP table
  // (as other decoders' do); pass them through face::limit_to_coding_range() before a face shows
  // them. not_ready: end_of_stream or need_more. corrupt_data, unsupported, out_of_capacity:
  // FbaFault.
  Status next(FbaPlane* plane, face::FapFrame* io_face, body::BapFrame* io_body);

  // Presentation time of the last plane, seconds: the running sum of (1 + skip) / rate, set anew by
  // time codes.
  double time_s() const { return time_s_; }
  const FbaRate& rate() const { return rate_; }
  // What the last intra planes set: masks, quantisers, ranges.
  const FbaCoding& coding() const { return coding_; }
  // FAPs that a mask says to hold rather than to interpolate, and that have a value. Add them to a
  // frame's mask before face::fill_from_partners().
  BitSet<face::kFapCount + 1> held_faps() const;
  // The value of a slot as the stream adds it up. Differs from the frames only for fields of FAPs 1
  // and 2, which hostile or coarsely quantised streams drive out of their ranges.
  std::int32_t slot_value(std::size_t slot) const { return value_[slot]; }
  std::size_t nodes_used() const { return pool_.used(); }
  std::uint32_t damaged_planes() const { return damaged_planes_; }

 private:
  // The fields of FAPs 1 and 2 that are sent as plain bits.
  struct RawFlags {
    bool viseme_def = false;
    bool init_face = false;
    bool expression_def = false;
  };

  Status find_start();
  Status pass_codes(bool* out_ended);
  Status search_intra();
  bool plausible_intra(std::size_t position);
  bool plausible_masks(BitReader bits, bool face) const;
  Status decode_plane(BitReader* bits, FbaPlane* plane);
  Status read_head(BitReader* bits, FbaPlane* plane) const;
  Status read_face_setup(BitReader* bits);
  Status read_body_setup(BitReader* bits);
  Status read_fap_range(BitReader* bits, std::int16_t LevelRange::*limit, int sign);
  Status read_bap_range(BitReader* bits, std::int16_t LevelRange::*limit, int sign);
  Status read_face_values(BitReader* bits, bool intra);
  Status read_body_values(BitReader* bits, bool intra);
  Status read_segment(BitReader* bits, bool intra, std::size_t first);
  Status commit(const FbaPlane& plane);
  void deliver(const FbaPlane& plane, face::FapFrame* face, body::BapFrame* body) const;
  Status fault(Code code, FbaFault what) const { return {code, static_cast<std::uint16_t>(what)}; }

  Options options_;
  std::span<const std::byte> bytes_;
  bool complete_ = false;
  std::size_t before_ = 0;    // Bytes of earlier pieces.
  std::size_t position_ = 0;  // Bits into bytes_.

  bool started_ = false;    // The object's start code has been passed.
  bool searching_ = false;  // Damage was met: looking for an intra plane.
  bool ended_ = false;
  std::uint32_t damaged_planes_ = 0;

  FbaCoding coding_;
  FbaRate rate_;
  double time_s_ = 0.0;
  double next_time_s_ = 0.0;
  std::array<std::int32_t, kFbaSlots> value_{};
  BitSet<face::kFapCount + 1> fap_seen_;
  RawFlags flags_;

  ModelPool pool_;
  std::array<AdaptiveModel, kFbaSlots> model_{};

  // The plane under way; becomes valid by commit() only, so that a plane of which a part is still
  // missing, or that is damaged, leaves no trace.
  FbaCoding pending_;
  bool pending_changed_ = true;  // pending_ may differ from coding_.
  RawFlags pending_flags_;
  FixedVector<std::uint16_t, kFbaSlots> pending_slot_;
  std::array<std::uint16_t, kFbaSlots> pending_symbol_{};
};

}  // namespace caryatid::stream
