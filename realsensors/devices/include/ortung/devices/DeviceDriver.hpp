#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Time.hpp"
#include "ortung/core/RobotCommands.hpp"
#include "ortung/core/SensorData.hpp"
#include "ortung/devices/Abi.hpp"

namespace ortung {

/// What a device says does not fit the robot file: other beams, no such sonar. Asking again is of
/// no use before somebody has changed one of the two.
class ORTUNG_API DeviceMisfit : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
  ~DeviceMisfit() override;
};

/// One reading as it came from a device.
struct DeviceReading {
  std::size_t feature = 0;  ///< index of the feature among those of serve()
  std::vector<std::uint32_t> words;
  /// When the device measured, on its own clock [us]; nothing if it has none.
  std::optional<Timestamp> deviceTime;
};

/// What speaks to one kind of device: a plugin, made from the `device` table of a robot file
/// without the keys that all devices have in common. One thread calls all of it, and none of it may
/// wait much longer than it is told: a device that does not answer is the usual case.
/// All functions may throw DeviceAbsent (not there, or gone) and DeviceMisfit; other exceptions
/// count as failures of the driver. After any of them the device is closed, and opened again later.
class ORTUNG_API DeviceDriver {
 public:
  static constexpr const char* kInterface = "ortung.DeviceDriver/" ORTUNG_DEVICES_ABI;
  virtual ~DeviceDriver();

  /// The features that the device fills, in the order of the robot file, before the first open().
  /// Names and settings of these may be read, readings not.
  /// @throws std::invalid_argument if it can't fill them
  virtual void serve(std::span<const SensorData* const> features) = 0;

  /// Connects, and makes the device measure. May take seconds where the device does.
  virtual void open() = 0;
  /// Appends what the device has measured, having waited for it until @p patience is over.
  virtual void read(std::chrono::milliseconds patience, std::vector<DeviceReading>& readings) = 0;
  virtual void close() noexcept = 0;

  /// How long ago a reading was measured when it comes, at least [s]: of sending it over a slow
  /// line. Of devices with a clock of their own it only shifts all stamps alike.
  virtual double latency() const { return 0.0; }
  /// What was thrown away so far since it made no sense: damaged telegrams, unknown lines.
  virtual std::uint64_t refused() const { return 0; }
  /// The robot's voice, if this device drives it; called from any thread.
  virtual RobotCommands* commands() { return nullptr; }
  /// Equal readings in a row from which on the device is taken to repeat its last one; 0: never.
  /// A scanner's noise never gives the same scan twice, while a robot at rest has equal odometry.
  virtual std::size_t repeatsOfFrozen() const { return 0; }
};

}  // namespace ortung
