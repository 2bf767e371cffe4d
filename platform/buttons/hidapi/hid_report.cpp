#include <algorithm>

#include "platform/buttons/hid.h"

namespace caryatid::platform {
namespace {

// Of the keyboard page (HID Usage Tables 1.12, section 10).
constexpr std::uint8_t kErrorRollOver = 0x01, kA = 0x04, k1 = 0x1e, k0 = 0x27, kEnter = 0x28;
constexpr std::uint8_t kKeypadEnter = 0x58, kKeypad1 = 0x59, kKeypad0 = 0x62, kFirstModifier = 0xe0;
// Readers type a code at 10 to 50 ms a key; what comes later is another code.
constexpr std::int64_t kCodePause_us = 500'000;

char letter_of(std::uint8_t usage) {
  if (usage >= kA && usage < k1) return static_cast<char>('a' + (usage - kA));
  if (usage >= k1 && usage < k0) return static_cast<char>('1' + (usage - k1));
  if (usage >= kKeypad1 && usage < kKeypad0) return static_cast<char>('1' + (usage - kKeypad1));
  return usage == k0 || usage == kKeypad0 ? '0' : '\0';
}

// The usages that a boot report says are down; false when it says "too many keys".
bool usages_of(std::span<const std::uint8_t> body, BitSet<256>* out) {
  out->clear();
  for (std::size_t bit = 0; bit < 8; ++bit)
    if ((body[0] >> bit & 1) != 0) out->set(kFirstModifier + bit);
  for (const std::uint8_t usage : body.subspan(2)) {
    if (usage == kErrorRollOver) return false;
    if (usage > kErrorRollOver) out->set(usage);
  }
  return true;
}

}  // namespace

void HidReader::feed(std::span<const std::uint8_t> report, std::int64_t now_us, bool quiet,
                     ButtonEvents& out) {
  if (device_.report_id != 0) {
    if (report.empty() || report[0] != device_.report_id) return;
    report = report.subspan(1);
  }
  if (device_.kind == HidKind::bits) {
    for (std::size_t i = 0; i < device_.keys.size(); ++i) {
      const HidKey& key = device_.keys[i];
      if (key.byte >= report.size()) continue;
      set_key(i, (report[key.byte] >> (key.bit & 7) & 1) != 0, now_us, quiet, out);
    }
    return;
  }
  if (report.size() < 3) return;
  if (device_.kind == HidKind::keyboard)
    feed_keyboard(report, now_us, quiet, out);
  else
    feed_wedge(report, now_us, quiet, out);
}

void HidReader::feed_keyboard(std::span<const std::uint8_t> body, std::int64_t now_us, bool quiet,
                              ButtonEvents& out) {
  BitSet<256> usages;
  if (!usages_of(body, &usages)) return;
  for (std::size_t i = 0; i < device_.keys.size(); ++i)
    set_key(i, usages.test(device_.keys[i].usage), now_us, quiet, out);
}

void HidReader::feed_wedge(std::span<const std::uint8_t> body, std::int64_t now_us, bool quiet,
                           ButtonEvents& out) {
  BitSet<256> usages;
  if (!usages_of(body, &usages)) return;
  for (const std::uint8_t usage : body.subspan(2))
    if (usage > kErrorRollOver && !typed_.test(usage)) type(usage, now_us, quiet, out);
  typed_ = usages;
}

void HidReader::type(std::uint8_t usage, std::int64_t now_us, bool quiet, ButtonEvents& out) {
  if (now_us - last_typed_us_ > kCodePause_us) {
    code_.clear();
    too_long_ = false;
  }
  last_typed_us_ = now_us;
  if (usage != kEnter && usage != kKeypadEnter) {
    const char letter = letter_of(usage);
    if (letter != '\0' && !code_.push(letter)) too_long_ = true;
    return;
  }
  for (const HidKey& key : device_.keys) {
    const auto wanted = key.code.span();
    const auto typed = code_.span();
    const bool same = std::equal(wanted.begin(), wanted.end(), typed.begin(), typed.end());
    if (quiet || too_long_ || wanted.empty() || !same) continue;
    // A code is a whole press.
    (void)out.push({key.button, true, now_us});
    (void)out.push({key.button, false, now_us});
  }
  code_.clear();
  too_long_ = false;
}

void HidReader::set_key(std::size_t index, bool down, std::int64_t now_us, bool quiet,
                        ButtonEvents& out) {
  if (down == down_.test(index)) return;
  down_.set(index, down);
  // A key that was pressed while quiet was not reported, and neither is its release.
  if (down ? quiet : !reported_.test(index)) return;
  reported_.set(index, down);
  (void)out.push({device_.keys[index].button, down, now_us});
}

void HidReader::release_all(std::int64_t now_us, ButtonEvents& out) {
  for (std::size_t i = 0; i < device_.keys.size(); ++i)
    if (reported_.test(i)) (void)out.push({device_.keys[i].button, false, now_us});
  down_.clear();
  reported_.clear();
  typed_.clear();
  code_.clear();
  too_long_ = false;
}

}  // namespace caryatid::platform
