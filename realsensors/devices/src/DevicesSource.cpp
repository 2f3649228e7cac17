#include "ortung/devices/DevicesSource.hpp"

#include <algorithm>
#include <stdexcept>

#include "ortung/robot/TomlFile.hpp"

namespace ortung {
namespace {

constexpr std::chrono::milliseconds kPatience{500};

}  // namespace

DevicesSource::DevicesSource(const Config& config)
    : robotToml_(readTomlText(config.robot)),
      robot_(readRobot(config.robot)),
      factory_(PluginFactory::standardFolders()),
      features_(fillContainer(container_, robot_, factory_)) {
  const std::vector<DeviceSettings> settings = readDevices(robot_, features_, config.dev);
  if (config.duration) end_ = clock_() + fromSeconds(*config.duration);
  devices_ = std::make_unique<RobotDevices>(settings, robot_.deviceWait, factory_, clock_);
}

DevicesSource::~DevicesSource() = default;

bool DevicesSource::isAtEnd() const { return end_ && clock_() >= *end_; }

std::optional<Message> DevicesSource::poll(std::chrono::milliseconds patience) {
  if (isAtEnd()) finish();
  if (end_) {
    const Timestamp left = std::max<Timestamp>(0, (*end_ - clock_()) / 1000 + 1);
    patience = std::min(patience, std::chrono::milliseconds(left));
  }
  return devices_->next(patience);
}

bool DevicesSource::next(Message& message) {
  while (true) {
    const bool wasAtEnd = isAtEnd();
    const Timestamp until = clock_() + 1000 * kPatience.count() / 2;
    if (auto reading = poll(kPatience)) {
      message = std::move(*reading);
      return true;
    }
    if (wasAtEnd) return false;
    if (clock_() < until && !isAtEnd())
      throw std::runtime_error("waiting for the robot's devices was interrupted");
  }
}

std::string DevicesSource::remark() const {
  std::string text;
  for (const DeviceStatus& one : devices_->status()) {
    if (one.state == DeviceState::kRunning) continue;
    text += (text.empty() ? "" : "; ") + one.name + ": " + toText(one.state) +
            (one.reason.empty() ? "" : ", " + one.reason);
  }
  return text;
}

}  // namespace ortung
