#include "SlowWork.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "BoardClock.hpp"
#include "Scheduling.hpp"
#include "ortung/server/ProcessorTime.hpp"

namespace ortung::server {
namespace {

constexpr double kShortestWait = 0.001;  // what is less is paid with the next piece [s]
constexpr double kLongestSleep = 0.05;   // so that the end is noticed [s]

}  // namespace

SlowWork::SlowWork(double share)
    : share_(share),
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
    const double wait = share_.charge(used_, wallTime());
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

void SlowWork::pace() {
  if (std::this_thread::get_id() != worker_.get_id()) return;
  used_ = processorTime();
  const std::stop_token stop = director_.get_stop_token();
  const auto wait = [this] { return share_.charge(used_, wallTime()); };
  for (double rest = wait(); rest >= kShortestWait && !stop.stop_requested(); rest = wait())
    std::this_thread::sleep_for(std::chrono::duration<double>(std::min(rest, kLongestSleep)));
}

}  // namespace ortung::server
