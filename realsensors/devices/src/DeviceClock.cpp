#include "ortung/devices/DeviceClock.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace ortung {
namespace {

constexpr Timestamp kSecond = 1'000'000;
constexpr std::size_t kKept = 60;            ///< number of seconds that are used
constexpr Timestamp kNeeded = 10 * kSecond;  ///< least time that shows a drift, not noise
constexpr Timestamp kSure = 30 * kSecond;    ///< least time that shows one beyond the greatest
constexpr double kMostDrift = 1e-6 * DeviceClock::kMostDriftPpm;

/// Least change of the difference, with an arrival before the envelope, that is a clock set [us];
/// and least fall within kFalling that only a queue explains, which is emptied.
constexpr double kStep = 5e5;
constexpr Timestamp kFalling = 10 * kSecond;
constexpr double kFallsOn = 2e4;         ///< least fall that shows that it is emptied still [us]
constexpr Timestamp kEmptied = 300'000;  ///< time without such a fall after which it is empty [us]

/// How much earlier than one that was used a reading may have been measured [us]: parts of a device
/// need not send in order. Stamps of others would be too late, as stamps never decrease.
constexpr Timestamp kDisorder = 50'000;

/// Times for which lateness must stay the same before the clock counts as set back [s].
constexpr double kSteadyAfterStep = 0.5;
constexpr double kSteadyAfterGap = 2.0;     // the line may have stalled, which a gap shows, too
constexpr double kSteadyAfterCreep = 30.0;  // no clock is set so; a full queue of a device is late
                                            // by the same time as long as it is flooded

}  // namespace

Timestamp DeviceClock::toHost(Timestamp arrival) {
  return inOrder(arrival - fromSeconds(config_.latency), arrival);
}

std::optional<Timestamp> DeviceClock::toHost(Timestamp device, Timestamp arrival) {
  device = std::clamp(device, -kFarthest, kFarthest);
  const bool isFresh = late_ == Late::kNot && !fall_.isOn && stamp_;
  const bool isSame = device_ && device == *device_ && !isReopened_ && isFresh;
  if (isSame && toSeconds(arrival - *stamp_) <= config_.latency + config_.lateAfter) return stamp_;
  const Timestamp difference = arrival - device;
  if (least_.empty()) {
    startOver(difference, arrival);
  } else {
    const double above = static_cast<double>(difference - base_) - envelope(device);
    const bool isAhead = above < -kStep;  // arrived before it was measured
    if (isReopened_ && (isAhead || device < *device_)) {
      startOver(difference, arrival);
    } else if (isAhead || isLate(device, arrival, above)) {
      ++jumps_;
      startOver(difference, arrival);
    }
  }
  isReopened_ = false;
  device_ = device;
  if (late_ != Late::kNot) return std::nullopt;
  note(device, static_cast<double>(difference - base_));
  above_ = static_cast<double>(difference - base_) - envelope(device);
  if (isEmptied(device, arrival)) return std::nullopt;
  if (used_ && device < *used_ - kDisorder) return std::nullopt;
  used_ = std::max(device, used_.value_or(device));
  const auto offset = static_cast<Timestamp>(std::llround(envelope(device)));
  return inOrder(device + base_ + offset - fromSeconds(config_.latency), arrival);
}

/// Begins the estimate anew with a reading.
void DeviceClock::startOver(Timestamp difference, Timestamp arrival) {
  least_.clear();
  base_ = difference;
  slope_ = 0.0;
  driftsTooMuch_ = false;
  above_ = 0.0;
  late_ = Late::kNot;
  steady_.clear();
  used_.reset();
  fall_ = {.from = static_cast<double>(difference), .fromAt = arrival};
}

/// Finds out whether a reading is late, and how that began.
/// @param above difference above the envelope [us]: the reading's delay
/// @return whether the device's clock was set back
bool DeviceClock::isLate(Timestamp device, Timestamp arrival, double above) {
  const double before = std::exchange(above_, above);
  if (above <= config_.lateAfter * kMicrosecondsPerSecond) {
    late_ = Late::kNot;
    return false;
  }
  if (late_ == Late::kNot) {
    steady_.clear();
    late_ = above - before > 0.5 * above ? Late::kGap : Late::kCreep;
    if (device < *device_) late_ = Late::kStep;
  }
  if (!steady_.note(arrival, static_cast<double>(arrival - device - base_))) return false;
  const double span = late_ == Late::kStep  ? kSteadyAfterStep
                      : late_ == Late::kGap ? kSteadyAfterGap
                                            : kSteadyAfterCreep;
  return steady_.isSteadyFor(span);
}

/// Returns whether a queue is emptied: each reading comes with a shorter delay than all before, so
/// none was in time. Then the envelope begins anew where the delays end to fall.
bool DeviceClock::isEmptied(Timestamp device, Timestamp arrival) {
  const double difference = static_cast<double>(arrival - device);
  if (!fall_.isOn) {
    const double now = static_cast<double>(base_) + envelope(device);
    if (arrival - fall_.fromAt > kFalling) fall_ = {.from = now, .fromAt = arrival};
    if (now > fall_.from - kStep) return false;
    fall_ = {.isOn = true, .to = difference, .device = device, .toAt = arrival};
    return true;
  }
  if (difference < fall_.to - kFallsOn) {
    fall_.to = difference;
    fall_.device = device;
    fall_.toAt = arrival;
  }
  if (arrival - fall_.toAt < kEmptied) return true;
  const Fall fall = fall_;
  startOver(static_cast<Timestamp>(fall.to), arrival);
  note(fall.device, 0.0);
  note(device, difference - fall.to);
  return false;
}

double DeviceClock::envelope(Timestamp device) const {
  return intercept_ + slope_ * static_cast<double>(device - least_.front().device);
}

void DeviceClock::note(Timestamp device, double difference) {
  const bool isNew = least_.empty() || device - least_.back().begin >= kSecond;
  if (isNew) {
    least_.push_back({device, device, difference});
    if (least_.size() > kKept) least_.pop_front();
  } else if (difference < least_.back().difference) {
    least_.back().device = device;
    least_.back().difference = difference;
  } else {
    return;
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
    const bool isBeyond = std::abs(slope_) > kMostDrift;
    driftsTooMuch_ = isBeyond && least_.back().device - first >= kSure;
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
  isReopened_ = device_.has_value();
  late_ = Late::kNot;
  steady_.clear();
}

std::optional<double> DeviceClock::delay() const {
  if (fall_.isOn) return std::nullopt;
  return std::max(0.0, above_) / kMicrosecondsPerSecond;
}

std::optional<Timestamp> DeviceClock::offset() const {
  if (least_.empty() || !device_) return std::nullopt;
  return base_ + static_cast<Timestamp>(std::llround(envelope(*device_)));
}

}  // namespace ortung
