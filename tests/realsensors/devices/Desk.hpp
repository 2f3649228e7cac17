#pragma once

#include <atomic>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "Await.hpp"
#include "Files.hpp"
#include "ortung/core/Source.hpp"
#include "ortung/devices/DevicesSource.hpp"
#include "ortung/emulators/EmulatorRun.hpp"

namespace ortung::test {

/// Readings that never repeat, ten times a second, without an end; remembers what it gave.
class Rehearsed : public Source {
 public:
  /// @param make the words of a feature in its n-th reading
  struct Part {
    SensorId id;
    std::function<std::vector<std::uint32_t>(std::size_t n)> make;
  };
  explicit Rehearsed(std::vector<Part> parts) : parts_(std::move(parts)) {}
  bool next(Message& message) override {
    const Part& part = parts_[next_ % parts_.size()];
    const std::size_t n = next_++ / parts_.size();
    message = {static_cast<Timestamp>(n) * 100'000, part.id, part.make(n)};
    const std::lock_guard lock(mutex_);
    given_[toText(part.id)].push_back(message.words);
    return true;
  }
  std::vector<std::vector<std::uint32_t>> given(const SensorId& id) {
    const std::lock_guard lock(mutex_);
    return given_[toText(id)];
  }

 private:
  std::vector<Part> parts_;
  std::size_t next_ = 0;
  std::mutex mutex_;
  std::map<std::string, std::vector<std::vector<std::uint32_t>>> given_;
};

/// A fault for so many seconds, again and again: a computer that was too busy to see the first one,
/// or to open the device before it, sees the next. It is well for twice as long each time, for
/// computers that take long to open it.
inline std::vector<std::string> againAndAgain(const std::string& fault, int seconds) {
  std::vector<std::string> faults;
  for (int from = 1, well = 3; from < 60; from += seconds + well, well *= 2)
    faults.push_back(fault + "@" + std::to_string(from) + "-" + std::to_string(from + seconds));
  return faults;
}

/// Emulated devices on one side of the table, the drivers of a robot file on the other.
class Desk {
 public:
  explicit Desk(Source& source) : source_(source) {}
  ~Desk() { isOver_ = true; }

  std::filesystem::path dev() const { return folder_.path(); }
  void add(std::unique_ptr<EmulatedDevice> device, std::unique_ptr<Endpoint> endpoint,
           const std::vector<std::string>& faults = {}) {
    EmulatorRun::Line line{std::move(device), std::move(endpoint)};
    for (const std::string& fault : faults) line.faults.push_back(parseEmulatorFault(fault));
    lines_.push_back(std::move(line));
  }
  /// Begins, and reads the devices of @p robot.
  DevicesSource& start(const std::string& robot, bool waits = true) {
    const std::filesystem::path file = folder_.path() / "robot.toml";
    writeBytes(file, robot);
    run_ = std::make_unique<EmulatorRun>(std::move(lines_), source_,
                                         EmulatorRun::Config{1.0, waits, 1});
    thread_ = std::jthread([this] { run_->run([this] { return !isOver_; }); });
    devices_ = std::make_unique<DevicesSource>(DevicesSource::Config{file, folder_.path()});
    return *devices_;
  }
  /// Readings of @p id, until there are so many.
  std::vector<Message> read(const SensorId& id, std::size_t count) {
    std::vector<Message> messages;
    EXPECT_TRUE(comesTrue("there are " + std::to_string(count) + " readings of " + toText(id), [&] {
      auto message = devices_->poll(std::chrono::milliseconds(100));
      if (message && message->id == id) messages.push_back(std::move(*message));
      return messages.size() >= count;
    }));
    return messages;
  }
  /// Reads on until so many readings of @p id came while device number @p device was in a state,
  /// which may be several times.
  void readWhile(std::size_t device, DeviceState state, const SensorId& id, int count) {
    const auto isIn = [&] { return devices_->status()[device].state == state; };
    EXPECT_TRUE(comesTrue("readings of " + toText(id) + " come meanwhile", [&] {
      const bool wasIn = isIn();
      const auto message = devices_->poll(std::chrono::milliseconds(50));
      if (wasIn && message && message->id == id && isIn()) --count;
      return count <= 0;
    }));
  }
  /// Reads on until @p isTrue of the status of device number @p device; what came of each feature
  /// meanwhile.
  std::map<std::string, std::vector<Message>> readUntil(
      std::size_t device, const std::function<bool(const DeviceStatus&)>& isTrue) {
    std::map<std::string, std::vector<Message>> messages;
    EXPECT_TRUE(comesTrue("the device is as it should be", [&] {
      if (isTrue(devices_->status()[device])) return true;
      if (auto message = devices_->poll(std::chrono::milliseconds(50))) {
        std::vector<Message>& ofFeature = messages[toText(message->id)];
        ofFeature.push_back(std::move(*message));
      }
      return false;
    }));
    return messages;
  }

 private:
  TemporaryFolder folder_;
  Source& source_;
  std::vector<EmulatorRun::Line> lines_;
  std::unique_ptr<EmulatorRun> run_;
  std::atomic<bool> isOver_ = false;
  std::jthread thread_;
  std::unique_ptr<DevicesSource> devices_;
};

}  // namespace ortung::test
