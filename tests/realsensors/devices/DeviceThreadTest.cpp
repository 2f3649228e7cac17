#include <gtest/gtest.h>

#include <atomic>
#include <condition_variable>
#include <mutex>

#include "FakeDriver.hpp"
#include "ortung/devices/DeviceThread.hpp"
#include "ortung/devices/HostClock.hpp"
#include "ortung/devices/Port.hpp"
#include "ortung/formats/ScalarData.hpp"

namespace ortung {
namespace {

/// Readings as a thread gives them; a test waits for as many as it needs.
class Sink {
 public:
  void add(Message message) {
    const std::lock_guard lock(mutex_);
    messages_.push_back(std::move(message));
    wake_.notify_all();
  }
  std::vector<Message> waitFor(std::size_t count) {
    std::unique_lock lock(mutex_);
    wake_.wait(lock, [&] { return messages_.size() >= count; });
    return messages_;
  }

 private:
  std::mutex mutex_;
  std::condition_variable wake_;
  std::vector<Message> messages_;
};

struct Threads : testing::Test {
  Threads() : feature({"m", "t", "f"}, {}, {}) {
    config.name = "fake";
    config.intake.health.openAfter = 1e-3;
    config.intake.health.openAfterMost = 1e-3;
  }
  std::unique_ptr<DeviceThread> start() {
    return std::make_unique<DeviceThread>(
        std::make_unique<test::FakeDriver>(script), std::vector<const SensorData*>{&feature},
        config, clock, [this](Message message) { sink.add(std::move(message)); });
  }
  static void give(std::vector<DeviceReading>& readings, std::uint32_t word) {
    readings.push_back({0, {word}, std::nullopt});
  }
  ScalarData feature;
  DeviceThread::Config config;
  HostClock clock;
  test::FakeDriver::Script script;
  Sink sink;
};

using DeviceThreadTest = Threads;

TEST_F(DeviceThreadTest, TriesADeviceThatIsAbsentUntilItIsThere) {
  for (int i = 0; i < 3; ++i) script.opens.push_back([] { throw DeviceAbsent("no such file"); });
  script.reads.push_back([](auto& readings) { give(readings, 17); });
  const auto thread = start();
  EXPECT_EQ(sink.waitFor(1).front().words.front(), 17U);
  const DeviceStatus status = thread->status();
  EXPECT_EQ(status.name, "fake");
  EXPECT_EQ(status.openings, 1U);
  EXPECT_EQ(status.readings, 1U);
}

TEST_F(DeviceThreadTest, OpensADeviceAnewThatWasUnplugged) {
  script.reads.push_back([](auto& readings) { give(readings, 1); });
  script.reads.push_back([](auto&) { throw DeviceAbsent("was closed"); });
  script.reads.push_back([](auto& readings) { give(readings, 2); });
  const auto thread = start();
  const auto messages = sink.waitFor(2);
  EXPECT_EQ(messages[1].words.front(), 2U);
  EXPECT_GT(messages[1].stamp, messages[0].stamp);
  EXPECT_EQ(thread->status().openings, 2U);
}

TEST_F(DeviceThreadTest, SurvivesWhateverADriverThrows) {
  script.opens.push_back([] { throw DeviceMisfit("other beams"); });
  script.reads.push_back([](auto&) { throw std::bad_alloc(); });
  script.reads.push_back([](auto& readings) { readings.push_back({99, {1}, std::nullopt}); });
  script.reads.push_back([](auto& readings) { give(readings, 3); });
  const auto thread = start();
  EXPECT_EQ(sink.waitFor(1).front().words.front(), 3U);
  EXPECT_EQ(thread->status().openings, 3U);
}

TEST_F(DeviceThreadTest, ClosesADeviceThatIsSilentForTooLong) {
  config.intake.health.reopenAfter = 1e-3;
  std::atomic<int> opened = 0;
  for (int i = 0; i < 3; ++i) {
    script.opens.push_back([&] {
      // Only the third time does it say something.
      if (++opened < 3) return;
      const std::lock_guard lock(script.mutex);
      script.reads.push_back([](auto& readings) { give(readings, 4); });
    });
  }
  const auto thread = start();
  sink.waitFor(1);
  EXPECT_GE(thread->status().openings, 3U);
}

TEST_F(DeviceThreadTest, IsLeftToItselfWhenItsDriverHangs) {
  // Shared: the thread outlives the test.
  struct Gate {
    std::mutex mutex;
    std::condition_variable wake;
    bool isEntered = false;
  };
  const auto gate = std::make_shared<Gate>();
  static test::FakeDriver::Script forever;
  forever.reads.push_back([gate](auto&) {
    std::unique_lock lock(gate->mutex);
    gate->isEntered = true;
    gate->wake.notify_all();
    gate->wake.wait(lock, [] { return false; });
  });
  static ScalarData lasting({"m", "t", "f"}, {}, {});
  auto thread = std::make_unique<DeviceThread>(std::make_unique<test::FakeDriver>(forever),
                                               std::vector<const SensorData*>{&lasting}, config,
                                               clock, [](Message) {});
  {
    std::unique_lock lock(gate->mutex);
    gate->wake.wait(lock, [&] { return gate->isEntered; });
  }
  thread.reset();  // comes back
  SUCCEED();
}

}  // namespace
}  // namespace ortung
