#include "ortung/core/PluginGuard.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <thread>
#include <utility>

#include "PluginProgress.hpp"
#include "ProcessorWaits.hpp"

namespace ortung {
namespace {

/// All guards of the process. There is one list for all, since plugins make guards, too (the source
/// `sim` has robots of its own), and a watch ends a program, not a robot.
struct Guards {
  std::mutex mutex;  ///< keeps a guard alive while it is checked
  std::set<const PluginGuard*> all;
};

/// Never destroyed: plugins that outlive main() leave it, too.
Guards& guards() {
  static auto* const guards = new Guards;
  return *guards;
}

constexpr double kStepsOfBudget = 10.0;
constexpr double kLongestStep = 0.25;  ///< [s]
// However busy the computer is, so much of the time counts: a call that never ends is found.
constexpr double kLeastShare = 0.1;

}  // namespace

PluginFailure::~PluginFailure() = default;

PluginGuard::PluginGuard(std::string who) : who_(std::move(who)) {
  const std::lock_guard lock(guards().mutex);
  guards().all.insert(this);
}

PluginGuard::~PluginGuard() {
  const std::lock_guard lock(guards().mutex);
  guards().all.erase(this);
}

void PluginGuard::fail(const char* what, const std::string& why) const {
  throw PluginFailure(who_ + " failed in " + what + ": " + why);
}

struct PluginWatch::Impl {
  /// A call that was running at the last check.
  struct Seen {
    std::uint64_t entered = 0;
    std::uint64_t left = 0;
    double seconds = 0.0;
  };

  Impl(double seconds, std::function<void(const std::string&)> overdue)
      : budget(seconds),
        step(std::min(seconds / kStepsOfBudget, kLongestStep)),
        tell(std::move(overdue)),
        thread([this] { watch(); }) {}

  ~Impl() {
    {
      const std::lock_guard lock(mutex);
      isOver = true;
    }
    end.notify_all();
    thread.join();
  }

  void watch() {
    using Clock = std::chrono::steady_clock;
    std::unique_lock lock(mutex);
    Clock::time_point before = Clock::now();
    while (!end.wait_for(lock, std::chrono::duration<double>(step), [&] { return isOver; })) {
      const Clock::time_point now = Clock::now();
      const double passed = std::chrono::duration<double>(now - before).count();
      before = now;
      const std::string late = look(passed);
      if (late.empty()) continue;
      lock.unlock();
      tell(late);
      return;
    }
  }

  /// How much of the time since the last look counts: not that in which the plugin's thread waited
  /// for a processor that others had. Which thread is the plugin's is not known, so it is the one
  /// that waited longest.
  double counted(double passed) {
    // If this thread wakes much too late, the process was suspended, and so were the plugins.
    const double most = std::min(passed, 2.0 * step);
    return std::clamp(passed - waits.sinceLast(), kLeastShare * most, most);
  }

  /// Which plugin is overdue, or "".
  std::string look(double passed) {
    const std::lock_guard lock(guards().mutex);
    const std::uint64_t progress = pluginProgress();
    const bool goesOn = std::exchange(noted, progress) != progress;
    std::map<const PluginGuard*, Seen> under;
    std::optional<double> time;
    for (const PluginGuard* guard : guards().all) {
      const std::uint64_t left = guard->left_.load(std::memory_order_acquire);
      const std::uint64_t entered = guard->entered_.load(std::memory_order_relaxed);
      if (entered == left) continue;
      const auto was = seen.find(guard);
      const bool isSame =
          was != seen.end() && was->second.entered == entered && was->second.left == left;
      if (!time) time = counted(passed);
      const double seconds = isSame && !goesOn ? was->second.seconds + *time : 0.0;
      if (seconds >= budget)
        return guard->who_ + " has been in " + guard->what_.load(std::memory_order_relaxed) +
               " for " + std::to_string(std::round(seconds * 10.0) / 10.0).substr(0, 5) + " s";
      under[guard] = {entered, left, seconds};
    }
    seen = std::move(under);
    if (!time) waits.forget();  // nothing is read of the system while no plugin is at work
    return "";
  }

  double budget;
  double step;
  std::function<void(const std::string&)> tell;
  std::map<const PluginGuard*, Seen> seen;
  std::uint64_t noted = 0;  ///< progress at the last look
  ProcessorWaits waits;
  std::mutex mutex;
  std::condition_variable end;
  bool isOver = false;
  std::thread thread;  ///< last: it uses the others
};

PluginWatch::PluginWatch(double seconds, std::function<void(const std::string&)> overdue) {
  if (!(seconds >= 0.0 && std::isfinite(seconds)))
    throw std::invalid_argument("PluginWatch: the time for a call is " + std::to_string(seconds) +
                                " s, expected a number >= 0");
  if (seconds > 0.0) impl_ = std::make_unique<Impl>(seconds, std::move(overdue));
}

PluginWatch::~PluginWatch() = default;

}  // namespace ortung
