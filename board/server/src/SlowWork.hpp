#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <stop_token>
#include <thread>

#include "TalkBudget.hpp"
#include "WorldKeeper.hpp"

namespace ortung::server {

/// What takes long, on a thread of its own that has the lowest priority and a share of one
/// processor: clients take turns, and a client has one task at a time. However much clients ask
/// for, the rest of the processors' time is others'.
class SlowWork {
 public:
  /// @param share of one processor, in (0, 1]; what is not used is kept for up to a second
  explicit SlowWork(double share);
  ~SlowWork();  ///< waits for the task under way; those that wait are dropped
  SlowWork(const SlowWork&) = delete;
  SlowWork& operator=(const SlowWork&) = delete;

  /// Gives a client's task. One that it has given before and that was not begun is dropped, and
  /// this one takes its place in the queue. Thread-safe.
  void give(ClientId client, std::function<void()> task);
  /// For a task: takes as long as its thread has to wait by now, so that long ones are no bursts.
  /// On other threads nothing happens. A task must not hold a lock meanwhile.
  void pace();

 private:
  void run(const std::stop_token& stop);
  std::function<void()> take(const std::stop_token& stop);
  void pay(const std::stop_token& stop);

  std::mutex mutex_;  ///< guards turns_ and tasks_
  std::condition_variable_any news_;
  std::deque<ClientId> turns_;  ///< who has a task, the next one first
  std::map<ClientId, std::function<void()>> tasks_;
  TalkBudget budget_;     ///< what it counts as lines are seconds of a processor
  double charged_ = 0.0;  ///< processor time of the thread that was paid for [s]
  std::jthread thread_;   ///< last member: it ends before what it uses
};

}  // namespace ortung::server
