#include "EvenTimes.hpp"

#include <cmath>

namespace ortung::app {
namespace {

constexpr Timestamp kLongestGap = 60'000'000;  // longest gap in which poses are requested [us]

}  // namespace

Timestamp EvenTimes::at(std::int64_t index) const {
  return *first_ + std::llround(static_cast<double>(index) * period_);
}

std::vector<Timestamp> EvenTimes::before(Timestamp stamp) {
  if (!first_ || stamp < last_) {
    first_ = last_ = stamp;
    next_ = 0;
  }
  std::vector<Timestamp> times;
  const bool isGap = stamp - last_ > kLongestGap;
  // Times that were due at the begin of a gap are still returned.
  for (const Timestamp end = isGap ? last_ + 1 : stamp; at(next_) < end; ++next_)
    times.push_back(at(next_));
  if (isGap) {
    next_ = std::llround(static_cast<double>(stamp - *first_) / period_);
    if (at(next_) < stamp) ++next_;
  }
  last_ = stamp;
  return times;
}

}  // namespace ortung::app
