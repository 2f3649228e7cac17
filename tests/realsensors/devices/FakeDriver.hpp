#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <utility>

#include "ortung/devices/DeviceDriver.hpp"

namespace ortung::test {

/// A device whose behaviour a test writes down, look by look.
class FakeDriver : public DeviceDriver {
 public:
  /// What happens at open() and read(); without one more, nothing comes any more.
  struct Script {
    std::deque<std::function<void()>> opens;
    std::deque<std::function<void(std::vector<DeviceReading>&)>> reads;
    std::mutex mutex;
    std::size_t closes = 0;
  };
  explicit FakeDriver(Script& script) : script_(script) {}
  void serve(std::span<const SensorData* const>) override {}
  void open() override {
    std::function<void()> act;
    {
      const std::lock_guard lock(script_.mutex);
      if (script_.opens.empty()) return;
      act = std::move(script_.opens.front());
      script_.opens.pop_front();
    }
    act();
  }
  void read(std::chrono::milliseconds, std::vector<DeviceReading>& readings) override {
    std::function<void(std::vector<DeviceReading>&)> act;
    {
      const std::lock_guard lock(script_.mutex);
      if (script_.reads.empty()) return;
      act = std::move(script_.reads.front());
      script_.reads.pop_front();
    }
    act(readings);
  }
  void close() noexcept override {
    const std::lock_guard lock(script_.mutex);
    ++script_.closes;
  }

 private:
  Script& script_;
};

}  // namespace ortung::test
