#include "ServiceDesk.hpp"

#include <utility>

namespace ortung::ros2 {

bool ServiceDesk::take(std::function<void()> job) {
  constexpr std::size_t kMostJobs = 64;
  const std::lock_guard lock(mutex_);
  if (isClosed_ || jobs_.size() >= kMostJobs) return false;
  jobs_.push_back(std::move(job));
  changed_.notify_one();
  return true;
}

void ServiceDesk::close() {
  {
    const std::lock_guard lock(mutex_);
    isClosed_ = true;
    changed_.notify_one();
  }
  if (thread_.joinable()) thread_.join();
}

void ServiceDesk::work() {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return isClosed_ || !jobs_.empty(); });
    if (isClosed_) return;
    const std::function<void()> job = std::move(jobs_.front());
    jobs_.pop_front();
    lock.unlock();
    job();
    lock.lock();
  }
}

}  // namespace ortung::ros2
