#include "SlowWork.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <utility>

#include "BoardClock.hpp"
#include "ortung/server/ProcessorTime.hpp"

namespace ortung::server {
namespace {

constexpr int kLowestPriority = 19;      // as of nice(1)
constexpr double kShortestWait = 0.001;  // what is less is paid with the next piece [s]

}  // namespace

SlowWork::SlowWork(double share)
    : budget_(share, 1.0), thread_([this](const std::stop_token& stop) { run(stop); }) {}

SlowWork::~SlowWork() = default;

void SlowWork::give(ClientId client, std::function<void()> task) {
  {
    const std::lock_guard lock(mutex_);
    if (!tasks_.contains(client)) turns_.push_back(client);
    tasks_[client] = std::move(task);
  }
  news_.notify_one();
}

void SlowWork::run(const std::stop_token& stop) {
  // Who answers clients at once, and the world, run whenever they want to. That it may be refused
  // (it never is by Linux) would do no harm.
  ::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), kLowestPriority);
  while (const std::function<void()> task = take(stop)) {
    task();
    pay(stop);
  }
}

/// The next client's task; none at the end.
std::function<void()> SlowWork::take(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  if (!news_.wait(lock, stop, [this] { return !turns_.empty(); }) || stop.stop_requested())
    return {};
  const auto its = tasks_.find(turns_.front());
  turns_.pop_front();
  std::function<void()> task = std::move(its->second);
  tasks_.erase(its);
  return task;
}

void SlowWork::pace() {
  if (std::this_thread::get_id() == thread_.get_id()) pay(thread_.get_stop_token());
}

/// Waits until what the thread has used is no more than its share.
void SlowWork::pay(const std::stop_token& stop) {
  const double used = processorTime();
  budget_.spend(used - std::exchange(charged_, used), 0.0);
  const double wait = budget_.wait(wallTime());
  if (wait < kShortestWait) return;
  std::unique_lock lock(mutex_);
  news_.wait_for(lock, stop, std::chrono::duration<double>(wait), [] { return false; });
}

}  // namespace ortung::server
