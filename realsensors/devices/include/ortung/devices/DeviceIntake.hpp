#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/core/Message.hpp"
#include "ortung/devices/DeviceClock.hpp"
#include "ortung/devices/DeviceDriver.hpp"
#include "ortung/devices/DeviceHealth.hpp"

namespace ortung {

/// Filters the readings of one device: stamps them by the host's clock, and drops those that are
/// invalid, repeated, late or too many. It has no clock: times are passed in. Not thread-safe.
class ORTUNG_API DeviceIntake {
 public:
  struct Config {
    DeviceClock::Config clock;        ///< how stamps are converted
    DeviceHealth::Config health;      ///< times until the device is stale, and reopened
    std::size_t repeatsOfFrozen = 0;  ///< equal consecutive readings of a frozen device; 0: never
    double mostPerSecond = 500.0;     ///< greatest rate of a feature [1/s]; more are dropped
  };
  /// @param features features by the index in DeviceReading; borrowed, their readings are not used
  DeviceIntake(const std::vector<const SensorData*>& features, const Config& config);

  /// Takes a reading.
  /// @param arrival time of arrival by the host's clock
  /// @returns the message to pass on, or nothing if the reading is dropped
  /// @throws std::invalid_argument for an index that is no feature's
  std::optional<Message> take(DeviceReading reading, Timestamp arrival);

  /// The state of the device.
  DeviceHealth& health() { return health_; }
  /// Reports that the device was opened: its clock may have restarted.
  void opened(Timestamp now);
  /// Returns the status without the name, and without what the driver refused and what was passed
  /// on too late.
  DeviceStatus status(Timestamp now) const;

 private:
  struct Feature {
    const SensorData* data;
    std::optional<Timestamp> deviceTime;
    std::vector<std::uint32_t> words;
    std::size_t equal = 0;             ///< number of consecutive readings equal to the newest
    std::optional<Timestamp> counted;  ///< arrival of the last reading that was not late
    double allowed = 0.0;              ///< number of readings that may pass at that time
  };
  /// Whether the device's time is one, and the feature accepts the words.
  static bool isSense(const Feature& feature, const DeviceReading& reading);
  /// Whether the device's time is that of the last reading.
  static bool repeatsItsTime(Feature& feature, const DeviceReading& reading);
  /// Whether too many consecutive readings were equal.
  bool isFrozen(Feature& feature, const DeviceReading& reading) const;
  /// Whether too many readings came within a second.
  bool isFlood(Feature& feature, Timestamp arrival) const;

  Config config_;
  std::vector<Feature> features_;
  DeviceClock clock_;
  DeviceHealth health_;
  bool hasClock_ = false;       ///< whether the newest reading has a device time
  std::uint64_t refused_ = 0;   ///< number of invalid readings
  std::uint64_t repeated_ = 0;  ///< number of repeated readings
  std::uint64_t late_ = 0;      ///< number of readings that were too old
  std::uint64_t flooded_ = 0;   ///< number of readings that came too fast
};

}  // namespace ortung
