#pragma once

#include <atomic>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include "ortung/base/Export.hpp"

namespace ortung {

/// Thrown when a plugin failed in a call: it threw something, or returned invalid numbers. The
/// message names the plugin, its robot and the call.
class ORTUNG_API PluginFailure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
  ~PluginFailure() override;
};

/// All calls into one running plugin go through its guard: drives, sensors, extractors and motion
/// models are called through a guard only. Whatever they throw comes out as PluginFailure, and a
/// PluginWatch sees when a call does not return. A guarded call costs two more atomic additions.
/// Thread-safe.
class ORTUNG_API PluginGuard {
 public:
  /// @param who the plugin's name in messages: "the drive plugin 'omni' of robot bob"
  explicit PluginGuard(std::string who);
  ~PluginGuard();
  PluginGuard(const PluginGuard&) = delete;
  PluginGuard& operator=(const PluginGuard&) = delete;

  /// Marks the plugin as busy while it lives: for calls whose errors are handled otherwise.
  class Inside {
   public:
    Inside(const PluginGuard& guard, const char* what) : guard_(guard) {
      guard_.what_.store(what, std::memory_order_relaxed);
      guard_.entered_.fetch_add(1, std::memory_order_relaxed);
    }
    ~Inside() { guard_.left_.fetch_add(1, std::memory_order_release); }
    Inside(const Inside&) = delete;
    Inside& operator=(const Inside&) = delete;

   private:
    const PluginGuard& guard_;
  };

  /// Calls the plugin. @param what name of its function; text that lives on
  /// @throws PluginFailure
  template <class Call>
  decltype(auto) operator()(const char* what, Call&& call) const {
    const Inside inside(*this, what);
    try {
      return std::forward<Call>(call)();
    } catch (const PluginFailure&) {
      throw;
    } catch (const std::exception& error) {
      fail(what, error.what());
    } catch (...) {
      fail(what, "it threw no std::exception");
    }
  }

  /// Reports an invalid result of the plugin. @throws PluginFailure
  [[noreturn]] void fail(const char* what, const std::string& why) const;

 private:
  friend class PluginWatch;

  std::string who_;
  mutable std::atomic<const char*> what_ = "";
  mutable std::atomic<std::uint64_t> entered_ = 0;  ///< calls that began
  mutable std::atomic<std::uint64_t> left_ = 0;     ///< calls that ended
};

/// Watches from a thread of its own whether a plugin stays in one call for too long. A thread can't
/// be ended from outside, so the program can only report it, save its data, and end. The watch does
/// nothing to the plugin, and samples calls in time steps of a tenth of the budget. Time in which
/// the whole program is stopped or suspended does not count.
class ORTUNG_API PluginWatch {
 public:
  /// @param seconds longest time that a call may take [s]; 0: no limit
  /// @param overdue called once, on the watch's thread, with the text of which plugin is in which
  ///   call for too long
  /// @throws std::invalid_argument for a time that is negative or no number
  PluginWatch(double seconds, std::function<void(const std::string&)> overdue);
  ~PluginWatch();
  PluginWatch(const PluginWatch&) = delete;
  PluginWatch& operator=(const PluginWatch&) = delete;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ortung
