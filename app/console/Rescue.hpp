#pragma once

#include <functional>
#include <mutex>
#include <string>

namespace ortung::app {

/// A function that saves data if a plugin does not return from a call: such a call can't be ended,
/// so the program is ended, and its data until then must not be lost. It is registered as long as
/// this lives.
class Rescue {
 public:
  /// @param save called on another thread, while no thread has hold(); may throw
  explicit Rescue(std::function<void()> save);
  ~Rescue();
  Rescue(const Rescue&) = delete;
  Rescue& operator=(const Rescue&) = delete;

  /// Locks out save(), for threads that change the data that it reads.
  std::unique_lock<std::mutex> hold() { return std::unique_lock(mutex_); }

  /// Calls all save functions, in the order in which they were registered, and ends the program.
  /// @param why reason, for stderr @param exitCode of the program
  [[noreturn]] static void saveAllAndEnd(const std::string& why, int exitCode);

 private:
  std::function<void()> save_;
  std::mutex mutex_;
};

}  // namespace ortung::app
