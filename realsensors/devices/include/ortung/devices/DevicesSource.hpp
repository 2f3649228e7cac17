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

/// The devices of a robot as a source, "devices:ROBOT.toml": live, without an end but a signal's.
/// Stamps are the time of day. Not thread-safe, but for what says so.
class ORTUNG_API DevicesSource : public Source {
 public:
  struct Config {
    std::filesystem::path robot;          ///< robot file
    std::filesystem::path dev = {};       ///< in place of "/dev"; "": the real one
    std::optional<double> duration = {};  ///< [s] from the opening on; nothing: until a signal
  };
  /// Opens all devices; those that are absent are tried again and again.
  /// @throws ConfigError, PluginError
  explicit DevicesSource(const Config& config);
  ~DevicesSource() override;

  /// Waits for as long as it takes. @throws std::runtime_error if a signal ends the wait
  bool next(Message& message) override;
  bool isLive() const override { return true; }
  std::string remark() const override;  ///< what was wrong with devices
  std::string robotToml() const override { return robotToml_; }

  /// Like next(), but nothing after @p patience, at the end and when a signal comes.
  std::optional<Message> poll(std::chrono::milliseconds patience);
  bool isAtEnd() const;

  const HostClock& clock() const { return clock_; }
  std::vector<DeviceStatus> status() const { return devices_->status(); }  ///< thread-safe
  RobotCommands* commands() const { return devices_->commands(); }

 private:
  std::string robotToml_;
  RobotConfig robot_;
  PluginFactory factory_;
  SensorContainer container_;  ///< tells the drivers what is to be filled
  std::vector<Device> features_;
  HostClock clock_;
  std::optional<Timestamp> end_;
  std::unique_ptr<RobotDevices> devices_;
};

}  // namespace ortung
