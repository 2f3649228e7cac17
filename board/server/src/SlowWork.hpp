#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <semaphore>
#include <stop_token>
#include <thread>

#include "ProcessorShare.hpp"
#include "SlowTask.hpp"
#include "WorldKeeper.hpp"

namespace ortung::server {

/// What takes long, beside the world and the conversations: clients take turns, a client has one
/// task at a time, and the work is done on a thread that has a low priority and a share of one
/// processor. However much clients ask for, the rest of the processors' time is others'.
///
/// A second thread, of the usual priority, takes tasks and passes on their results: the first one
/// may be without a processor for long, so it must not hold a lock that others wait for.
class SlowWork {
 public:
  /// @param share of one processor, in (0, 1]; what is not used is kept for up to a second
  explicit SlowWork(double share);
  ~SlowWork();  ///< waits for the task under way; those that wait are dropped
  SlowWork(const SlowWork&) = delete;
  SlowWork& operator=(const SlowWork&) = delete;

  /// Gives a client's task. One that it has given before and that was not begun is dropped, and
  /// this one takes its place in the queue. Thread-safe.
  void give(ClientId client, SlowTask task);
  /// For a task's work: takes as long as it has to wait by now, so that long work is no burst. On
  /// other threads nothing happens. The work must not hold a lock meanwhile.
  void pace();

 private:
  void work();
  void direct(const std::stop_token& stop);
  std::optional<SlowTask> take(const std::stop_token& stop);

  std::mutex mutex_;  ///< guards turns_ and tasks_; not for the thread that works
  std::condition_variable_any news_;
  std::deque<ClientId> turns_;  ///< who has a task, the next one first
  std::map<ClientId, SlowTask> tasks_;
  // Both threads use these, but never at the same time: one waits for the other.
  const std::function<void()>* job_ = nullptr;  ///< null: the end
  ProcessorShare share_;
  double used_ = 0.0;  ///< processor time of the thread that works [s]
  std::binary_semaphore begins_{0};
  std::binary_semaphore ends_{0};
  std::thread worker_;
  std::jthread director_;
};

}  // namespace ortung::server
