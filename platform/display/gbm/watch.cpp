#include "platform/display/gbm/watch.h"

namespace caryatid::platform::gbm {
namespace {

constexpr std::int64_t kPeriod_us = 1'000'000;

}  // namespace

ScreenWatch::Action ScreenWatch::due(std::int64_t now_us) {
  if (now_us < next_us_) return Action::nothing;
  next_us_ = now_us + kPeriod_us;
  return in_use_ ? Action::look : Action::probe;
}

bool ScreenWatch::change(bool in_use) {
  in_use_ = in_use;
  const bool is_news = !told_ || told_in_use_ != in_use;
  told_ = true;
  told_in_use_ = in_use;
  return is_news;
}

}  // namespace caryatid::platform::gbm
