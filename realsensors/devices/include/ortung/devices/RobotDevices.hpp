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

/// One device of a robot file, from the `device` of one or several [[sensor]] tables. Tables with
/// the same plugin and port are one device; the first one of them has its settings.
struct DeviceSettings {
  std::string plugin;                       ///< name of the driver's plugin
  std::string port;                         ///< port as the robot file has it
  Parameters parameters;                    ///< settings that the driver reads, port included
  DeviceIntake::Config intake;              ///< how readings are filtered
  std::optional<double> latency;            ///< least delay [s]; nothing: the driver's
  std::optional<std::size_t> repeats;       ///< repeatsOfFrozen; nothing: the driver's
  std::vector<const SensorData*> features;  ///< features that the device fills; borrowed
};

/// Reads the `device` tables of a robot file.
/// @param devices features of the robot, with their tables
/// @param dev folder in place of "/dev", with the links of emulated devices; "": the real one
/// @throws ConfigError, also if there is no device at all
ORTUNG_API std::vector<DeviceSettings> readDevices(const RobotConfig& robot,
                                                   std::span<const Device> devices,
                                                   const std::filesystem::path& dev);

/// All devices of a robot, each with its own thread, and their readings in the order of time.
/// One thread calls next(); the rest is thread-safe.
class ORTUNG_API RobotDevices {
 public:
  /// Starts the threads of all devices.
  /// @param wait greatest time that readings of one device wait for those of others, in addition
  ///   to the greatest latency of the devices [s]
  /// @param clock returns the host's time; called from all threads
  /// @throws ConfigError, PluginError
  RobotDevices(const std::vector<DeviceSettings>& devices, double wait, PluginFactory& factory,
               std::function<Timestamp()> clock);
  ~RobotDevices();
  RobotDevices(const RobotDevices&) = delete;
  RobotDevices& operator=(const RobotDevices&) = delete;

  /// Returns the next reading; waits for it for at most @p patience, then nothing. A signal to the
  /// waiting thread ends the wait.
  std::optional<Message> next(std::chrono::milliseconds patience);

  /// Takes no more readings: from now on next() gives those that wait for others, without waiting,
  /// then nothing.
  void finish();

  /// Returns the status of each device.
  std::vector<DeviceStatus> status() const;
  /// The interface for commands of the first device that has one, or null.
  RobotCommands* commands() const;

 private:
  void push(std::size_t device, Message message);
  void awaitThoseThatRun();

  std::function<Timestamp()> clock_;
  mutable std::mutex mutex_;  ///< guards the next two members
  Merger merger_{0, 0.0};
  bool isFinished_ = false;
  int wake_ = -1;  ///< eventfd that new readings wake: unlike a condition, a signal interrupts it
  std::vector<std::unique_ptr<DeviceThread>> threads_;  ///< last: they end before what they use
};

}  // namespace ortung
