#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

namespace ortung::ros2 {

/// Does jobs one after another on a thread of its own, so that threads of DDS don't wait for them.
/// Thread-safe.
class ServiceDesk {
 public:
  ServiceDesk() : thread_([this] { work(); }) {}
  ~ServiceDesk() { close(); }
  ServiceDesk(const ServiceDesk&) = delete;
  ServiceDesk& operator=(const ServiceDesk&) = delete;

  /// Takes a job, which must not throw. @return whether there was room for it
  bool take(std::function<void()> job);
  /// Ends the thread; jobs that wait are left undone.
  void close();

 private:
  void work();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> jobs_;
  bool isClosed_ = false;
  std::thread thread_;  ///< last, since it uses the others
};

}  // namespace ortung::ros2
