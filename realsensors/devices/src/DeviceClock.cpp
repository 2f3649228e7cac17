#include "ortung/devices/DeviceClock.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace ortung {
namespace {

constexpr Timestamp kSecond = 1'000'000;
constexpr std::size_t kKept = 60;            ///< number of seconds that are used
constexpr Timestamp kNeeded = 10 * kSecond;  ///< least time that shows a drift, not noise
constexpr double kMostDrift = 1e-3;          ///< greatest drift; crystals are 100 x better

}  // namespace

Timestamp DeviceClock::toHost(Timestamp arrival) {
  return inOrder(arrival - fromSeconds(config_.latency), arrival);
}

Timestamp DeviceClock::toHost(Timestamp device, Timestamp arrival) {
  device = std::clamp(device, -kFarthest, kFarthest);
  const bool isSame = device_ && device == *device_ && stamp_ && !least_.empty();
  if (isSame && !standsStill(arrival)) return *stamp_;
  const Timestamp difference = arrival - device;
  if (!least_.empty() &&
      hasJumped(device, arrival, static_cast<double>(difference - base_) - envelope(device))) {
    ++jumps_;
    least_.clear();
  }
  if (least_.empty()) {
    base_ = difference;
    slope_ = 0.0;
    lateSince_.reset();
  }
  note(device, static_cast<double>(difference - base_));
  device_ = device;
  const auto offset = static_cast<Timestamp>(std::llround(envelope(device)));
  return inOrder(device + base_ + offset - fromSeconds(config_.latency), arrival);
}

/// Returns whether the newest stamp is too old for readings of one time to arrive as late.
bool DeviceClock::standsStill(Timestamp arrival) const {
  return toSeconds(arrival - *stamp_) > config_.latency + config_.longest;
}

/// Returns whether the device's clock was set.
/// @param above difference above the envelope [us]: the reading's delay
bool DeviceClock::hasJumped(Timestamp device, Timestamp arrival, double above) {
  const double jump = config_.jump * kMicrosecondsPerSecond;
  if (above < -jump) return true;                 // arrived before it was measured
  if (device_ && device < *device_) return true;  // device time decreased
  if (above <= jump) {
    lateSince_.reset();
    return false;
  }
  if (above > config_.longest * kMicrosecondsPerSecond) return true;
  // Either this reading and the following ones are delayed, or the clock was set back by less than
  // it has run since its last reading, or it stood still.
  if (!lateSince_) lateSince_ = arrival;
  return toSeconds(arrival - *lateSince_) > config_.patience;
}

double DeviceClock::envelope(Timestamp device) const {
  return intercept_ + slope_ * static_cast<double>(device - least_.front().device);
}

void DeviceClock::note(Timestamp device, double difference) {
  if (least_.empty() || device - least_.back().begin >= kSecond) {
    least_.push_back({device, device, difference});
    if (least_.size() > kKept) least_.pop_front();
  } else if (difference < least_.back().difference) {
    least_.back().device = device;
    least_.back().difference = difference;
  }
  fit();
}

/// Finds the edge of the lower convex hull that lies below the middle of all minima.
void DeviceClock::fit() {
  const Timestamp first = least_.front().device;
  const auto x = [first](const Least& one) { return static_cast<double>(one.device - first); };
  slope_ = 0.0;
  if (least_.back().device - first >= kNeeded) {
    std::vector<const Least*> hull;
    double middle = 0.0;
    for (const Least& one : least_) {
      middle += x(one) / static_cast<double>(least_.size());
      while (hull.size() >= 2) {
        const Least& a = *hull[hull.size() - 2];
        const Least& b = *hull.back();
        const double turn = (x(b) - x(a)) * (one.difference - a.difference) -
                            (b.difference - a.difference) * (x(one) - x(a));
        if (turn > 0.0) break;
        hull.pop_back();
      }
      hull.push_back(&one);
    }
    for (std::size_t i = 1; i < hull.size(); ++i) {
      const double run = x(*hull[i]) - x(*hull[i - 1]);
      slope_ = (hull[i]->difference - hull[i - 1]->difference) / run;
      if (x(*hull[i]) >= middle) break;
    }
    slope_ = std::clamp(slope_, -kMostDrift, kMostDrift);
  }
  intercept_ = least_.front().difference;
  for (const Least& one : least_)
    intercept_ = std::min(intercept_, one.difference - slope_ * x(one));
}

Timestamp DeviceClock::inOrder(Timestamp stamp, Timestamp arrival) {
  stamp = std::min(stamp, arrival);
  if (stamp_ && stamp <= *stamp_) stamp = *stamp_ + 1;
  stamp_ = stamp;
  return stamp;
}

void DeviceClock::restart() {
  least_.clear();
  device_.reset();
  lateSince_.reset();
}

std::optional<Timestamp> DeviceClock::offset() const {
  if (least_.empty() || !device_) return std::nullopt;
  return base_ + static_cast<Timestamp>(std::llround(envelope(*device_)));
}

}  // namespace ortung
