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
    case DeviceState::kLate:
      return "late";
  }
  return "";
}

bool DeviceHealth::mustClose(Timestamp now) const {
  if (!isOpen_) return false;
  const Timestamp alive = std::max(openedAt_, lastSign_.value_or(openedAt_));
  return since(alive, now) > config_.reopenAfter;
}

bool DeviceHealth::mustRefresh(Timestamp now) const {
  return isOpen_ && lateSince_ && now >= nextRefresh_;
}

void DeviceHealth::opened(Timestamp now) {
  isOpen_ = true;
  isMisfit_ = false;
  repeats_ = false;
  lateSince_.reset();
  openedAt_ = now;
  ++openings_;
}

void DeviceHealth::closed(Timestamp now, bool isMisfit, const std::string& why) {
  isOpen_ = false;
  isMisfit_ = isMisfit;
  hasFailed_ = true;
  reason_ = why;
  const double most = isMisfit ? config_.misfitAfterMost : config_.openAfterMost;
  wait_ = std::min(wait_ == 0.0 ? config_.openAfter : 2.0 * wait_, most);
  nextTry_ = now + fromSeconds(wait_);
}

void DeviceHealth::tookReading(Timestamp now) {
  wait_ = 0.0;
  hasFailed_ = false;
  repeats_ = false;
  lateSince_.reset();
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

void DeviceHealth::sawLate(Timestamp now, std::optional<double> delay) {
  if (!lateSince_) {
    lateSince_ = now;
    refreshWait_ = config_.refreshAfter;
    nextRefresh_ = now + fromSeconds(refreshWait_);
  }
  repeats_ = false;
  delay_ = delay;
  lastSign_ = now;
}

void DeviceHealth::refreshed(Timestamp now) {
  refreshWait_ = std::min(2.0 * refreshWait_, config_.refreshAfterMost);
  nextRefresh_ = now + fromSeconds(refreshWait_);
}

DeviceState DeviceHealth::state(Timestamp now) const {
  if (!isOpen_) {
    if (!hasFailed_) return DeviceState::kOpening;
    return isMisfit_ ? DeviceState::kFailed : DeviceState::kAbsent;
  }
  if (lateSince_ && since(*lastSign_, now) <= config_.staleAfter) return DeviceState::kLate;
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
    case DeviceState::kLate:
      status.reason = delay_ ? "its readings are " + seconds(*delay_) + " old when they arrive"
                             : "its readings were held up, and come all at once";
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
