#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/core/Source.hpp"
#include "ortung/devices/HostClock.hpp"
#include "ortung/devices/RobotDevices.hpp"

namespace ortung {

/// The devices of a robot as a source, "devices:ROBOT.toml": live, until the duration is over or a
/// signal comes. Stamps are the time of day. Not thread-safe, except where stated.
class ORTUNG_API DevicesSource : public Source {
 public:
  struct Config {
    std::filesystem::path robot;          ///< the robot file
    std::filesystem::path dev = {};       ///< folder in place of "/dev"; "": the real one
    std::optional<double> duration = {};  ///< time from the opening on [s]; nothing: unlimited
  };
  /// Opens all devices; those that are absent are tried again and again.
  /// @throws ConfigError, PluginError
  explicit DevicesSource(const Config& config);
  ~DevicesSource() override;

  /// Waits for the next reading; false at the end. @throws std::runtime_error at a signal
  bool next(Message& message) override;
  /// Always: readings come in real time.
  bool isLive() const override { return true; }
  std::string remark() const override;  ///< problems of devices, or ""
  /// The robot file's text.
  std::string robotToml() const override { return robotToml_; }

  /// Returns the next reading, or nothing after @p patience, at the end and at a signal. Behind the
  /// end it still gives the readings that have come and wait for those of other devices.
  std::optional<Message> poll(std::chrono::milliseconds patience);
  /// Ends the run now: poll() then gives the readings that have come, and next() is false.
  void finish() { devices_->finish(); }
  /// Whether the duration is over.
  bool isAtEnd() const;

  /// The clock of the stamps.
  const HostClock& clock() const { return clock_; }
  /// The status of each device. Thread-safe.
  std::vector<DeviceStatus> status() const { return devices_->status(); }
  /// The robot's interface for commands, or null. Thread-safe.
  RobotCommands* commands() const { return devices_->commands(); }

 private:
  std::string robotToml_;
  RobotConfig robot_;
  PluginFactory factory_;
  SensorContainer container_;  ///< features that the drivers fill
  std::vector<Device> features_;
  HostClock clock_;
  std::optional<Timestamp> end_;
  std::unique_ptr<RobotDevices> devices_;
};

}  // namespace ortung
