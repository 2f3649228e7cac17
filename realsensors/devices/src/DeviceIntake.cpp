#include "ortung/devices/DeviceIntake.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace ortung {
namespace {

/// Share of a second's readings that may come at once: those of a line that stalled for so long.
constexpr double kAtOnce = 0.5;

}  // namespace

DeviceIntake::DeviceIntake(const std::vector<const SensorData*>& features, const Config& config)
    : config_(config), clock_(config.clock), health_(config.health) {
  for (const SensorData* data : features) {
    features_.emplace_back();
    features_.back().data = data;
  }
}

std::optional<Message> DeviceIntake::take(DeviceReading reading, Timestamp arrival) {
  if (reading.feature >= features_.size())
    throw std::invalid_argument("feature " + std::to_string(reading.feature) + " of " +
                                std::to_string(features_.size()));
  Feature& feature = features_[reading.feature];
  if (!isSense(feature, reading)) {
    ++refused_;
    return std::nullopt;
  }
  if (repeatsItsTime(feature, reading) || isFrozen(feature, reading)) {
    ++repeated_;
    health_.sawRepeat(arrival);
    return std::nullopt;
  }
  hasClock_ = reading.deviceTime.has_value();
  const std::optional<Timestamp> stamp =
      hasClock_ ? clock_.toHost(*reading.deviceTime, arrival) : clock_.toHost(arrival);
  if (!stamp) {
    ++late_;
    health_.sawLate(arrival, clock_.delay());
    return std::nullopt;
  }
  if (isFlood(feature, arrival)) {
    ++flooded_;
    return std::nullopt;
  }
  feature.deviceTime = reading.deviceTime;
  health_.tookReading(arrival);
  return Message{*stamp, feature.data->id(), std::move(reading.words)};
}

/// Checks the time, and the words: those that the feature refuses would end the readers of the
/// container.
bool DeviceIntake::isSense(const Feature& feature, const DeviceReading& reading) {
  constexpr Timestamp kFarthest = DeviceClock::kFarthest;
  if (reading.deviceTime && (*reading.deviceTime > kFarthest || *reading.deviceTime < -kFarthest))
    return false;
  try {
    feature.data->checkData(reading.words);
    return true;
  } catch (const std::invalid_argument&) {
    return false;
  }
}

/// Returns whether the device's time did not advance: it can't have measured since.
bool DeviceIntake::repeatsItsTime(Feature& feature, const DeviceReading& reading) {
  return reading.deviceTime && feature.deviceTime && *reading.deviceTime == *feature.deviceTime;
}

bool DeviceIntake::isFrozen(Feature& feature, const DeviceReading& reading) const {
  if (config_.repeatsOfFrozen == 0) return false;
  if (reading.words == feature.words) {
    ++feature.equal;
  } else {
    feature.words = reading.words;
    feature.equal = 1;
  }
  return feature.equal > config_.repeatsOfFrozen;
}

/// Readings that pass are spread evenly over a flood, so that the newest of them is never old, and
/// none is missing after it.
bool DeviceIntake::isFlood(Feature& feature, Timestamp arrival) const {
  const double most = std::max(1.0, kAtOnce * config_.mostPerSecond);
  const double since = feature.counted ? toSeconds(arrival - *feature.counted) : 0.0;
  feature.allowed =
      feature.counted
          ? std::min(most, feature.allowed + std::max(0.0, since) * config_.mostPerSecond)
          : most;
  feature.counted = arrival;
  if (feature.allowed < 1.0) return true;
  feature.allowed -= 1.0;
  return false;
}

void DeviceIntake::opened(Timestamp now) {
  clock_.restart();
  for (Feature& feature : features_) feature.deviceTime.reset();
  health_.opened(now);
}

DeviceStatus DeviceIntake::status(Timestamp now) const {
  DeviceStatus status = health_.status(now);
  status.refused = refused_;
  status.repeated = repeated_;
  status.late = late_;
  status.flooded = flooded_;
  status.clockJumps = clock_.jumps();
  if (!hasClock_) return status;
  status.driftPpm = clock_.driftPpm();
  status.driftsTooMuch = clock_.driftsTooMuch();
  return status;
}

}  // namespace ortung
