#include "ortung/devices/DeviceHealth.hpp"

#include <algorithm>
#include <cstdio>

namespace ortung {
namespace {

constexpr Timestamp kRateOver = 2'000'000;  ///< time over which the rate is measured [us]
constexpr std::size_t kCounted = 20'000;    ///< greatest number of readings in that time

std::string seconds(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.1f s", value);
  return text;
}

}  // namespace

const char* toText(DeviceState state) {
  switch (state) {
    case DeviceState::kOpening:
      return "opening";
    case DeviceState::kAbsent:
      return "absent";
    case DeviceState::kRunning:
      return "running";
    case DeviceState::kStale:
      return "stale";
    case DeviceState::kFrozen:
      return "frozen";
    case DeviceState::kFailed:
      return "failed";
  }
  return "";
}

bool DeviceHealth::mustClose(Timestamp now) const {
  if (!isOpen_) return false;
  const Timestamp alive = std::max(openedAt_, lastSign_.value_or(openedAt_));
  return since(alive, now) > config_.reopenAfter;
}

void DeviceHealth::opened(Timestamp now) {
  isOpen_ = true;
  isMisfit_ = false;
  repeats_ = false;
  openedAt_ = now;
  ++openings_;
}

void DeviceHealth::closed(Timestamp now, bool isMisfit, const std::string& why) {
  isOpen_ = false;
  isMisfit_ = isMisfit;
  hasFailed_ = true;
  reason_ = why;
  wait_ = wait_ == 0.0 ? config_.openAfter : std::min(2.0 * wait_, config_.openAfterMost);
  nextTry_ = now + fromSeconds(wait_);
}

void DeviceHealth::tookReading(Timestamp now) {
  wait_ = 0.0;
  hasFailed_ = false;
  repeats_ = false;
  lastReading_ = now;
  lastSign_ = now;
  ++readings_;
  recent_.push_back(now);
  while (recent_.front() <= now - kRateOver || recent_.size() > kCounted) recent_.pop_front();
}

void DeviceHealth::sawRepeat(Timestamp now) {
  repeats_ = true;
  lastSign_ = now;
}

DeviceState DeviceHealth::state(Timestamp now) const {
  if (!isOpen_) {
    if (!hasFailed_) return DeviceState::kOpening;
    return isMisfit_ ? DeviceState::kFailed : DeviceState::kAbsent;
  }
  const Timestamp alive = std::max(openedAt_, lastReading_.value_or(openedAt_));
  if (since(alive, now) > config_.staleAfter)
    return repeats_ ? DeviceState::kFrozen : DeviceState::kStale;
  const bool hasMeasured = lastReading_ && *lastReading_ >= openedAt_;
  return hasMeasured ? DeviceState::kRunning : DeviceState::kOpening;
}

DeviceStatus DeviceHealth::status(Timestamp now) const {
  DeviceStatus status;
  status.state = state(now);
  status.readings = readings_;
  status.openings = openings_;
  if (lastReading_) status.age = std::max(0.0, since(*lastReading_, now));
  const auto first = std::find_if(recent_.begin(), recent_.end(),
                                  [&](Timestamp one) { return one > now - kRateOver; });
  status.rate = static_cast<double>(recent_.end() - first) / toSeconds(kRateOver);
  const double silent = since(std::max(openedAt_, lastReading_.value_or(openedAt_)), now);
  switch (status.state) {
    case DeviceState::kRunning:
      break;
    case DeviceState::kStale:
      status.reason = "no reading for " + seconds(silent);
      break;
    case DeviceState::kFrozen:
      status.reason = "the same reading for " + seconds(silent);
      break;
    default:
      status.reason = reason_;
  }
  return status;
}

}  // namespace ortung
