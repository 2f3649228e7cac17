#include "ortung/devices/RobotDevices.hpp"

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <limits>
#include <stdexcept>
#include <system_error>

namespace ortung {
namespace {

constexpr std::string_view kDev = "/dev/";

std::string placeOf(const std::string& port, const std::filesystem::path& dev) {
  if (dev.empty() || !port.starts_with(kDev)) return port;
  // Drivers of other libraries take a relative path for a name within /dev.
  return (std::filesystem::absolute(dev) / port.substr(kDev.size())).string();
}

DeviceSettings readDevice(const Parameters& table, const std::filesystem::path& dev) {
  DeviceSettings device;
  device.plugin = table.text("plugin");
  device.port = table.text("port");
  DeviceIntake::Config& intake = device.intake;
  intake.health.staleAfter = table.numberOr("stale_after_s", 1.0, {0.01, 3600.0});
  intake.health.reopenAfter = std::max(5.0, 3.0 * intake.health.staleAfter);
  intake.clock.lateAfter = table.numberOr("late_after_s", intake.clock.lateAfter, {0.01, 60.0});
  intake.mostPerSecond = table.numberOr("most_per_s", intake.mostPerSecond, {1.0, 1e5});
  if (table.has("latency_s")) device.latency = table.number("latency_s", {0.0, 10.0});
  if (table.has("repeats"))
    device.repeats = static_cast<std::size_t>(table.integer("repeats", {0, 1e6}));
  device.parameters = table;  // its other keys are read by the driver
  if (const std::string place = placeOf(device.port, dev); place != device.port)
    device.parameters.set("port", place);
  return device;
}

void refuseSettings(const Parameters& table, const DeviceSettings& first) {
  for (const std::string& key : table.keys())
    if (key != "plugin" && key != "port")
      table.fail(key, "is in the second table of " + first.plugin + " at " + first.port +
                          "; expected all settings in the first one, plugin and port alone here");
}

}  // namespace

std::vector<DeviceSettings> readDevices(const RobotConfig& robot, std::span<const Device> devices,
                                        const std::filesystem::path& dev) {
  std::vector<DeviceSettings> found;
  for (const Device& device : devices) {
    const Parameters& table = device.config->device;
    if (table.keys().empty()) continue;
    const std::string plugin = table.text("plugin");
    const std::string port = table.text("port");
    auto same = std::find_if(found.begin(), found.end(), [&](const DeviceSettings& one) {
      return one.plugin == plugin && one.port == port;
    });
    if (same == found.end()) {
      found.push_back(readDevice(table, dev));
      same = found.end() - 1;
    } else {
      refuseSettings(table, *same);
    }
    for (const SensorData* data : device.data) same->features.push_back(data);
  }
  if (found.empty())
    throw ConfigError(robot.about.where() +
                      ": names no device; expected device = { plugin = \"...\", port = \"...\" } "
                      "in a [[sensor]]");
  return found;
}

RobotDevices::RobotDevices(const std::vector<DeviceSettings>& devices, double wait,
                           PluginFactory& factory, std::function<Timestamp()> clock)
    : clock_(std::move(clock)) {
  std::vector<std::unique_ptr<DeviceDriver>> drivers;
  for (const DeviceSettings& device : devices) {
    drivers.push_back(factory.make<DeviceDriver>(device.plugin, device.parameters));
    try {
      drivers.back()->serve(device.features);
    } catch (const std::invalid_argument& error) {
      throw ConfigError(device.parameters.where() + ": device " + device.plugin + " at " +
                        device.port + ": " + error.what());
    }
  }
  wake_ = ::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
  if (wake_ < 0) throw std::runtime_error("eventfd: " + std::generic_category().message(errno));
  double slowest = 0.0;
  for (std::size_t i = 0; i < devices.size(); ++i)
    slowest = std::max(slowest, devices[i].latency.value_or(drivers[i]->latency()));
  merger_ = Merger(devices.size(), wait + slowest);
  for (std::size_t i = 0; i < devices.size(); ++i) {
    DeviceThread::Config config{devices[i].plugin + " " + devices[i].port, devices[i].intake};
    config.intake.clock.latency = devices[i].latency.value_or(drivers[i]->latency());
    config.intake.repeatsOfFrozen = devices[i].repeats.value_or(drivers[i]->repeatsOfFrozen());
    threads_.push_back(std::make_unique<DeviceThread>(
        std::move(drivers[i]), devices[i].features, config, clock_,
        [this, i](Message message) { push(i, std::move(message)); }));
  }
}

RobotDevices::~RobotDevices() {
  threads_.clear();
  ::close(wake_);
}

void RobotDevices::push(std::size_t device, Message message) {
  {
    const std::lock_guard lock(mutex_);
    if (isFinished_) return;
    merger_.push(device, std::move(message));
  }
  const std::uint64_t one = 1;
  [[maybe_unused]] const ssize_t written = ::write(wake_, &one, sizeof(one));
}

void RobotDevices::finish() {
  const std::lock_guard lock(mutex_);
  isFinished_ = true;
}

/// Lets readings wait for running devices only.
void RobotDevices::awaitThoseThatRun() {
  for (std::size_t i = 0; i < threads_.size(); ++i) {
    const bool runs = threads_[i]->status().state == DeviceState::kRunning;
    const std::lock_guard lock(mutex_);
    merger_.await(i, runs);
  }
}

std::optional<Message> RobotDevices::next(std::chrono::milliseconds patience) {
  const Timestamp end = clock_() + 1000 * patience.count();
  while (true) {
    awaitThoseThatRun();
    Timestamp until = end;
    {
      const std::lock_guard lock(mutex_);
      if (isFinished_) return merger_.pop(std::numeric_limits<Timestamp>::max());
      if (std::optional<Message> message = merger_.pop(clock_())) return message;
      if (const auto due = merger_.due()) until = std::min(until, *due);
    }
    const Timestamp now = clock_();
    if (now >= end) return std::nullopt;
    pollfd one{wake_, POLLIN, 0};
    const auto milliseconds = std::clamp<Timestamp>((until - now + 999) / 1000, 0, 1000);
    if (::poll(&one, 1, static_cast<int>(milliseconds)) < 0) return std::nullopt;  // a signal
    std::uint64_t count = 0;
    [[maybe_unused]] const ssize_t read = ::read(wake_, &count, sizeof(count));
  }
}

std::vector<DeviceStatus> RobotDevices::status() const {
  std::vector<DeviceStatus> all;
  for (std::size_t i = 0; i < threads_.size(); ++i) {
    all.push_back(threads_[i]->status());
    const std::lock_guard lock(mutex_);
    all.back().late += merger_.late(i) + merger_.lost(i);
  }
  return all;
}

RobotCommands* RobotDevices::commands() const {
  for (const auto& thread : threads_)
    if (RobotCommands* const voice = thread->commands()) return voice;
  return nullptr;
}

}  // namespace ortung
