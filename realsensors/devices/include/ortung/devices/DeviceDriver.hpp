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

/// A device does not fit the robot file: it has other beams, or not the sonar. Trying again does
/// not help until the user changes one of the two.
class ORTUNG_API DeviceMisfit : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
  ~DeviceMisfit() override;
};

/// One reading as it came from a device.
struct DeviceReading {
  std::size_t feature = 0;           ///< index of the feature among those of serve()
  std::vector<std::uint32_t> words;  ///< words as the feature's SensorData reads them
  /// Time of measurement by the device's clock [us]; nothing if it has none.
  std::optional<Timestamp> deviceTime;
};

/// The driver of one kind of device: a plugin, made from the `device` table of a robot file without
/// the keys that all devices have in common. One thread calls all functions but commands(), and
/// none may wait much longer than its @p patience: a device that does not answer is usual.
/// All functions may throw DeviceAbsent (not there, or gone) and DeviceMisfit; other exceptions
/// count as failures of the driver. After any of them the device is closed, and reopened later.
class ORTUNG_API DeviceDriver {
 public:
  /// Name and version of the interface, which plugins and program compare.
  static constexpr const char* kInterface = "ortung.DeviceDriver/" ORTUNG_DEVICES_ABI;
  virtual ~DeviceDriver();

  /// Sets the features that the device fills. Called once, before the first open().
  /// @param features in the order of the robot file; their names and settings may be read, their
  ///   readings not
  /// @throws std::invalid_argument if the driver can't fill them
  virtual void serve(std::span<const SensorData* const> features) = 0;

  /// Connects, and makes the device measure. May take as many seconds as the device needs.
  virtual void open() = 0;
  /// Appends what the device has measured; waits for it for at most @p patience.
  virtual void read(std::chrono::milliseconds patience, std::vector<DeviceReading>& readings) = 0;
  /// Drops what the device has measured and not delivered yet, as far as that can be done: readings
  /// have been arriving too late, so something holds them up.
  virtual void refresh();
  /// Disconnects. Also called for a device that is not open.
  virtual void close() noexcept = 0;

  /// The least delay between measurement and arrival of a reading [s], e.g. of sending it over a
  /// slow line. For devices with a clock it shifts all stamps by the same time.
  virtual double latency() const { return 0.0; }
  /// Number of items that were refused so far: damaged telegrams, unknown lines.
  virtual std::uint64_t refused() const { return 0; }
  /// The interface for commands if this device drives the robot, or null; called from any thread.
  virtual RobotCommands* commands() { return nullptr; }
  /// Number of equal consecutive readings after which the device counts as frozen; 0: never. A
  /// scanner's noise never gives the same scan twice, while a robot at rest has equal odometry.
  virtual std::size_t repeatsOfFrozen() const { return 0; }
};

}  // namespace ortung
