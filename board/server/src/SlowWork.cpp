#include "SlowWork.hpp"

#include <sched.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <utility>

#include "BoardClock.hpp"
#include "ortung/server/ProcessorTime.hpp"

namespace ortung::server {
namespace {

// As of nice(1): a tenth of the weight of others. Lower ones would keep readings from a container,
// of which it looks at a few under a lock, for too long where others have all processors.
constexpr int kPriority = 10;
// A thread that wakes up preempts at once one whose slice is longer than its own; otherwise it
// waits for the end of that slice, up to 3 ms. Before Linux 6.12 all slices have the same length
// [ns].
constexpr std::uint64_t kSlice = 100'000'000;
constexpr double kShortestWait = 0.001;  // what is less is paid with the next piece [s]
constexpr double kLongestSleep = 0.05;   // so that the end is noticed [s]

/// What sched_setattr(2) takes; glibc 2.36 has no name for it, and Linux' own header can't stand
/// beside <sched.h>.
struct Scheduling {
  std::uint32_t size = 0;
  std::uint32_t policy = 0;
  std::uint64_t flags = 0;
  std::int32_t nice = 0;
  std::uint32_t priority = 0;
  std::uint64_t runtime = 0;
  std::uint64_t deadline = 0;
  std::uint64_t period = 0;
};

/// For the thread that calls. If the system refuses, answers come at the cost of others.
void stepBack() {
  Scheduling scheduling{
      .size = sizeof(Scheduling), .policy = SCHED_OTHER, .nice = kPriority, .runtime = kSlice};
  ::syscall(SYS_sched_setattr, 0, &scheduling, 0U);
}

}  // namespace

SlowWork::SlowWork(double share)
    : budget_(share, 1.0),
      worker_([this] { work(); }),
      director_([this](const std::stop_token& stop) { direct(stop); }) {}

SlowWork::~SlowWork() {
  director_.request_stop();
  director_.join();
  job_ = nullptr;
  begins_.release();
  worker_.join();
}

void SlowWork::give(ClientId client, SlowTask task) {
  {
    const std::lock_guard lock(mutex_);
    if (!tasks_.contains(client)) turns_.push_back(client);
    tasks_[client] = std::move(task);
  }
  news_.notify_one();
}

void SlowWork::work() {
  stepBack();
  while (true) {
    begins_.acquire();
    if (job_ == nullptr) return;
    (*job_)();
    used_ = processorTime();
    ends_.release();
  }
}

void SlowWork::direct(const std::stop_token& stop) {
  while (const std::optional<SlowTask> task = take(stop)) {
    if (!task->begin()) continue;
    job_ = &task->work;
    begins_.release();
    ends_.acquire();
    task->done();
    const double wait = charge();
    if (wait < kShortestWait) continue;
    std::unique_lock lock(mutex_);
    news_.wait_for(lock, stop, std::chrono::duration<double>(wait), [] { return false; });
  }
}

/// The next client's task; nothing at the end.
std::optional<SlowTask> SlowWork::take(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  if (!news_.wait(lock, stop, [this] { return !turns_.empty(); }) || stop.stop_requested())
    return std::nullopt;
  const auto its = tasks_.find(turns_.front());
  turns_.pop_front();
  std::optional<SlowTask> task = std::move(its->second);
  tasks_.erase(its);
  return task;
}

/// Pays for the processor time that was used. @returns how long to wait for it [s]
double SlowWork::charge() {
  budget_.spend(used_ - std::exchange(charged_, used_), 0.0);
  return budget_.wait(wallTime());
}

void SlowWork::pace() {
  if (std::this_thread::get_id() != worker_.get_id()) return;
  used_ = processorTime();
  const std::stop_token stop = director_.get_stop_token();
  for (double wait = charge(); wait >= kShortestWait && !stop.stop_requested(); wait = charge())
    std::this_thread::sleep_for(std::chrono::duration<double>(std::min(wait, kLongestSleep)));
}

}  // namespace ortung::server
