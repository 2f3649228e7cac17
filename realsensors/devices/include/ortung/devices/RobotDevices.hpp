#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/core/PluginFactory.hpp"
#include "ortung/devices/DeviceThread.hpp"
#include "ortung/devices/Merger.hpp"
#include "ortung/robot/RobotFile.hpp"

namespace ortung {

/// One device of a robot file: what `device` of one or several [[sensor]] tables says. Tables with
/// the same plugin and port are one device; its settings stand in the first one of them.
struct DeviceSettings {
  std::string plugin;
  std::string port;       ///< as the robot file has it
  Parameters parameters;  ///< what the driver reads, port included
  DeviceIntake::Config intake;
  std::optional<double> latency;            ///< [s]; nothing: the driver's
  std::optional<std::size_t> repeats;       ///< of a frozen device; nothing: the driver's
  std::vector<const SensorData*> features;  ///< that it fills, borrowed
};

/// Reads the `device` tables.
/// @param dev in place of "/dev": where the links of emulated devices are; "": the real one
/// @throws ConfigError, also if there is no device at all
ORTUNG_API std::vector<DeviceSettings> readDevices(const RobotConfig& robot,
                                                   std::span<const Device> devices,
                                                   const std::filesystem::path& dev);

/// All devices of a robot, each with a thread of its own, and their readings in the order of time.
/// One thread calls next(); the rest is thread-safe.
class ORTUNG_API RobotDevices {
 public:
  /// Begins at once.
  /// @param wait how long readings of one device wait for those of others, beyond the greatest
  ///   latency that a device is known to have [s]
  /// @param clock our time, called from all threads
  /// @throws ConfigError, PluginError
  RobotDevices(const std::vector<DeviceSettings>& devices, double wait, PluginFactory& factory,
               std::function<Timestamp()> clock);
  ~RobotDevices();
  RobotDevices(const RobotDevices&) = delete;
  RobotDevices& operator=(const RobotDevices&) = delete;

  /// The next reading, having waited for it until @p patience is over, or nothing. A signal to the
  /// waiting thread ends the wait.
  std::optional<Message> next(std::chrono::milliseconds patience);

  std::vector<DeviceStatus> status() const;
  /// The robot's voice, of the first device that has one, or null.
  RobotCommands* commands() const;

 private:
  void push(std::size_t device, Message message);
  void awaitThoseThatRun();

  std::function<Timestamp()> clock_;
  mutable std::mutex mutex_;  ///< of merger_
  Merger merger_{0, 0.0};
  int wake_ = -1;  ///< an eventfd, since a signal ends waiting for it
  std::vector<std::unique_ptr<DeviceThread>> threads_;  ///< last: they end before what they use
};

}  // namespace ortung
