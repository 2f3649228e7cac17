#pragma once

#include <functional>
#include <mutex>
#include <string>

namespace ortung::app {

/// What is to be saved if a plugin does not come back from a call: such a call can't be ended, so
/// the program is, and what it has until then must not be lost. As long as it lives.
class Rescue {
 public:
  /// @param save called on another thread, while nobody has hold(); may throw
  explicit Rescue(std::function<void()> save);
  ~Rescue();
  Rescue(const Rescue&) = delete;
  Rescue& operator=(const Rescue&) = delete;

  /// Nothing is saved meanwhile: for whoever changes what save() looks at.
  std::unique_lock<std::mutex> hold() { return std::unique_lock(mutex_); }

  /// Lets all save, and ends the program. @param why for stderr
  [[noreturn]] static void saveAllAndEnd(const std::string& why);

 private:
  std::function<void()> save_;
  std::mutex mutex_;
};

}  // namespace ortung::app
