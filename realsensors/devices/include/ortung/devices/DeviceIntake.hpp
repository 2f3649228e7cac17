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

/// What becomes of the readings of one device: they are stamped by our clock, and those that make
/// no sense, are no news, or too many, are left out. Knows no clock: times are passed in. Not
/// thread-safe.
class ORTUNG_API DeviceIntake {
 public:
  struct Config {
    DeviceClock::Config clock;
    DeviceHealth::Config health;
    std::size_t repeatsOfFrozen = 0;  ///< equal readings in a row; 0: never
    double mostPerSecond = 500.0;     ///< of one feature; more are left out
  };
  /// @param features by the index in DeviceReading; borrowed, their readings are not looked at
  DeviceIntake(std::vector<const SensorData*> features, const Config& config);

  /// @param arrival when it came, on our clock
  /// @returns what to pass on, or nothing
  /// @throws std::invalid_argument for a feature that is not there
  std::optional<Message> take(DeviceReading reading, Timestamp arrival);

  DeviceHealth& health() { return health_; }
  /// The device was opened: its clock may have begun again.
  void opened(Timestamp now);
  /// All but name, what the driver has refused and what was late.
  DeviceStatus status(Timestamp now) const;

 private:
  struct Feature {
    const SensorData* data;
    std::optional<Timestamp> deviceTime;
    std::vector<std::uint32_t> words;
    std::size_t equal = 0;  ///< readings like the newest one, in a row
    Timestamp second = 0;   ///< in which `inSecond` are counted
    std::size_t inSecond = 0;
  };
  static bool isSense(const Feature& feature, const DeviceReading& reading);
  static bool repeatsItsTime(Feature& feature, const DeviceReading& reading);
  bool isFrozen(Feature& feature, const DeviceReading& reading) const;
  bool isFlood(Feature& feature, Timestamp arrival) const;

  Config config_;
  std::vector<Feature> features_;
  DeviceClock clock_;
  DeviceHealth health_;
  bool hasClock_ = false;
  std::uint64_t refused_ = 0;
  std::uint64_t repeated_ = 0;
  std::uint64_t flooded_ = 0;
};

}  // namespace ortung
