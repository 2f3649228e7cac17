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

/// What a plugin did wrong at its work: it threw something, or gave numbers that make no sense. The
/// message names the plugin, whose it is and the call.
class ORTUNG_API PluginFailure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
  ~PluginFailure() override;
};

/// The way into one plugin at work: drives, sensors, extractors and motion models are called
/// through a guard alone. Whatever they throw comes out as PluginFailure, and a PluginWatch sees
/// when a call does not come back. A call costs two atomic additions more.
/// Thread-safe.
class ORTUNG_API PluginGuard {
 public:
  /// @param who for messages: "the drive plugin 'omni' of robot bob"
  explicit PluginGuard(std::string who);
  ~PluginGuard();
  PluginGuard(const PluginGuard&) = delete;
  PluginGuard& operator=(const PluginGuard&) = delete;

  /// As long as it lives, the plugin is at work: for calls whose errors are dealt with otherwise.
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

  /// For what the plugin gave back. @throws PluginFailure
  [[noreturn]] void fail(const char* what, const std::string& why) const;

 private:
  friend class PluginWatch;

  std::string who_;
  mutable std::atomic<const char*> what_ = "";
  mutable std::atomic<std::uint64_t> entered_ = 0;  ///< calls that began
  mutable std::atomic<std::uint64_t> left_ = 0;     ///< calls that ended
};

/// Looks from a thread of its own whether a plugin stays in one call for longer than it may: a
/// thread can't be ended from outside, so all that is left is to say so, save what there is, and
/// end the program. It does nothing to the plugin, and learns of calls in time steps of a tenth of
/// the budget. Time in which the whole program stands still (stopped, asleep) does not count.
class ORTUNG_API PluginWatch {
 public:
  /// @param seconds a call may take; 0: as long as it likes
  /// @param overdue is told which plugin is in which call for too long, once, on the watch's thread
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
