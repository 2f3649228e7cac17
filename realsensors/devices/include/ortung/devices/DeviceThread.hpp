#pragma once

#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Time.hpp"
#include "ortung/core/Message.hpp"
#include "ortung/devices/DeviceDriver.hpp"
#include "ortung/devices/DeviceHealth.hpp"
#include "ortung/devices/DeviceIntake.hpp"

namespace ortung {

/// A thread that keeps one device running: it opens the device, takes its readings, closes it when
/// something is wrong and tries again, each time a little later. It blocks all signals.
class ORTUNG_API DeviceThread {
 public:
  struct Config {
    std::string name;             ///< plugin and port, for users
    DeviceIntake::Config intake;  ///< how readings are filtered
  };
  /// Starts the thread.
  /// @param features the features that the driver fills; borrowed
  /// @param clock returns the host's time; called from the thread
  /// @param sink gets the readings in the order of their stamps; called from the thread
  DeviceThread(std::unique_ptr<DeviceDriver> driver, const std::vector<const SensorData*>& features,
               const Config& config, std::function<Timestamp()> clock,
               std::function<void(Message)> sink);
  /// Waits a few seconds for the thread; a thread that hangs in its driver is abandoned.
  ~DeviceThread();
  DeviceThread(const DeviceThread&) = delete;
  DeviceThread& operator=(const DeviceThread&) = delete;

  /// Returns the status without what came too late. Thread-safe.
  DeviceStatus status() const;
  /// The driver's interface for commands, or null. Thread-safe.
  RobotCommands* commands() const;

 private:
  struct Shared;  ///< state that lives as long as the thread
  static void run(const std::stop_token& stop, Shared& shared);
  std::shared_ptr<Shared> shared_;
  std::jthread thread_;
};

}  // namespace ortung
