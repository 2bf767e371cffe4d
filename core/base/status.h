#pragma once
#include <cstdint>

namespace caryatid {

// Why an operation did not do what was asked. Programmer errors are not here: they assert.
enum class Code : std::uint8_t {
  ok,
  invalid_argument,  // The caller broke the contract of a public function in a checkable way.
  out_of_capacity,   // A fixed limit of core/base/limits.h, or a span that is too short.
  corrupt_data,      // Bytes from outside are not what their format promises.
  unsupported,       // Well formed, but a version, mode or feature that this build does not have.
  not_ready,         // More input or another step is needed first; try again.
  device_lost,       // The device behind a platform service is gone.
  io,                // The operating system refused; platform keeps errno.
};

// Result of an operation that can fail. 4 bytes, returned by value, never ignored.
struct [[nodiscard]] Status {
  Code code = Code::ok;
  std::uint16_t detail =
      0;  // Which check refused: the room's own enumeration, 0 when there is no more to say.

  constexpr bool ok() const { return code == Code::ok; }
  friend constexpr bool operator==(Status, Status) = default;
};
static_assert(sizeof(Status) == 4);

// A value or the reason why there is none. For small, trivially copyable T.
template <class T>
struct [[nodiscard]] Result {
  Status status{};
  T value{};

  constexpr bool ok() const { return status.ok(); }
};

}  // namespace caryatid

// Returns the Status of `expr` from the enclosing function unless it is ok.
#define CARYATID_TRY(expr)                                                        \
  do {                                                                            \
    if (const ::caryatid::Status caryatid_status = (expr); !caryatid_status.ok()) \
      return caryatid_status;                                                     \
  } while (false)
