#include "ortung/devices/DeviceThread.hpp"

#include <chrono>
#include <condition_variable>
#include <csignal>
#include <exception>
#include <mutex>
#include <utility>

#include "ortung/devices/Port.hpp"

namespace ortung {
namespace {

constexpr std::chrono::milliseconds kPatience{100};  ///< longest wait for a reading
constexpr std::chrono::milliseconds kBreath{2};  ///< sleep after each read, limits a flood's load
constexpr std::chrono::seconds kLongestEnd{3};   ///< longest wait for the thread's end

/// Blocks all signals in threads that are started while it lives.
class SignalsElsewhere {
 public:
  SignalsElsewhere() {
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before_);
  }
  ~SignalsElsewhere() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  SignalsElsewhere(const SignalsElsewhere&) = delete;
  SignalsElsewhere& operator=(const SignalsElsewhere&) = delete;

 private:
  sigset_t before_{};
};

}  // namespace

struct DeviceThread::Shared {
  std::unique_ptr<DeviceDriver> driver;
  std::string name;
  std::function<Timestamp()> clock;
  std::function<void(Message)> sink;
  std::mutex mutex;  ///< guards the members that follow
  std::condition_variable_any wake;
  DeviceIntake intake;
  std::uint64_t refused = 0;
  bool isDone = false;

  bool mayOpen() {
    const std::lock_guard lock(mutex);
    return intake.health().mayOpen(clock());
  }
  bool isOpen() {
    const std::lock_guard lock(mutex);
    return intake.health().isOpen();
  }
  bool mustClose() {
    const std::lock_guard lock(mutex);
    return intake.health().mustClose(clock());
  }
  /// Returns whether the driver must refresh the device now, which counts as done.
  bool mustRefresh() {
    const std::lock_guard lock(mutex);
    const Timestamp now = clock();
    const bool isDue = intake.health().mustRefresh(now);
    if (isDue) intake.health().refreshed(now);
    return isDue;
  }
  void opened() {
    const std::lock_guard lock(mutex);
    intake.opened(clock());
  }
  void closed(bool isMisfit, const std::string& why) {
    driver->close();
    const std::lock_guard lock(mutex);
    intake.health().closed(clock(), isMisfit, why);
  }
  void take(std::vector<DeviceReading> readings) {
    const Timestamp arrival = clock();
    for (DeviceReading& reading : readings) {
      std::optional<Message> message;
      {
        const std::lock_guard lock(mutex);
        message = intake.take(std::move(reading), arrival);
        refused = driver->refused();
      }
      if (message) sink(std::move(*message));
    }
  }
  /// Reads the device once. @throws what the driver throws, and DeviceAbsent if it must be closed
  void look() {
    std::vector<DeviceReading> readings;
    driver->read(kPatience, readings);
    {
      const std::lock_guard lock(mutex);
      refused = driver->refused();
    }
    take(std::move(readings));
    if (mustClose()) throw DeviceAbsent("gave no reading for too long");
    if (mustRefresh()) driver->refresh();
  }
};

void DeviceThread::run(const std::stop_token& stop, Shared& shared) {
  const auto pause = [&](std::chrono::milliseconds time) {
    std::unique_lock lock(shared.mutex);
    shared.wake.wait_for(lock, stop, time, [] { return false; });
  };
  while (!stop.stop_requested()) {
    try {
      if (shared.isOpen()) {
        shared.look();
        pause(kBreath);
      } else if (shared.mayOpen()) {
        shared.driver->open();
        shared.opened();
      } else {
        pause(kPatience);
      }
    } catch (const DeviceAbsent& error) {
      shared.closed(false, error.what());
    } catch (const std::exception& error) {
      shared.closed(true, error.what());
    }
  }
  shared.driver->close();
}

DeviceThread::DeviceThread(std::unique_ptr<DeviceDriver> driver,
                           const std::vector<const SensorData*>& features, const Config& config,
                           std::function<Timestamp()> clock, std::function<void(Message)> sink)
    : shared_(new Shared{.driver = std::move(driver),
                         .name = config.name,
                         .clock = std::move(clock),
                         .sink = std::move(sink),
                         .mutex = {},
                         .wake = {},
                         .intake = DeviceIntake(features, config.intake)}) {
  const SignalsElsewhere signals;
  thread_ = std::jthread([shared = shared_](const std::stop_token& stop) {
    run(stop, *shared);
    const std::lock_guard lock(shared->mutex);
    shared->isDone = true;
    shared->wake.notify_all();
  });
}

DeviceThread::~DeviceThread() {
  thread_.request_stop();
  bool isDone = false;
  {
    std::unique_lock lock(shared_->mutex);
    isDone = shared_->wake.wait_for(lock, kLongestEnd, [this] { return shared_->isDone; });
    if (!isDone) shared_->sink = [](const Message&) {};
  }
  if (!isDone) thread_.detach();
}

DeviceStatus DeviceThread::status() const {
  const std::lock_guard lock(shared_->mutex);
  DeviceStatus status = shared_->intake.status(shared_->clock());
  status.name = shared_->name;
  status.refused += shared_->refused;
  return status;
}

RobotCommands* DeviceThread::commands() const { return shared_->driver->commands(); }

}  // namespace ortung
