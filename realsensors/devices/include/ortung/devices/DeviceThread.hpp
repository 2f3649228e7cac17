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

/// A thread that keeps one device running: opens it, takes its readings, closes it when something
/// is wrong and tries again, a little later each time. Signals are for other threads.
class ORTUNG_API DeviceThread {
 public:
  struct Config {
    std::string name;  ///< plugin and port, for people
    DeviceIntake::Config intake;
  };
  /// Begins at once.
  /// @param features what the driver serves, borrowed
  /// @param clock our time; called from the thread
  /// @param sink is given readings, in the order of their stamps; called from the thread
  DeviceThread(std::unique_ptr<DeviceDriver> driver, std::vector<const SensorData*> features,
               const Config& config, std::function<Timestamp()> clock,
               std::function<void(Message)> sink);
  /// Waits a few seconds for the thread; one that hangs in its driver is left to itself.
  ~DeviceThread();
  DeviceThread(const DeviceThread&) = delete;
  DeviceThread& operator=(const DeviceThread&) = delete;

  /// All but what came too late. Thread-safe.
  DeviceStatus status() const;
  RobotCommands* commands() const;

 private:
  struct Shared;  ///< outlives this, if the thread does
  static void run(const std::stop_token& stop, Shared& shared);
  std::shared_ptr<Shared> shared_;
  std::jthread thread_;
};

}  // namespace ortung
