#pragma once

#include <chrono>

#include "ortung/base/Time.hpp"

namespace ortung {

/// A clock that shows the time of day at its construction plus the steady time since then, so it
/// does not jump while a robot runs. Thread-safe; copies show the same time.
class HostClock {
 public:
  /// Reads the time of day.
  HostClock()
      : offset_(std::chrono::duration_cast<std::chrono::microseconds>(
                    std::chrono::system_clock::now().time_since_epoch())
                    .count() -
                steady()) {}
  /// Returns the time since 1970 [us].
  Timestamp operator()() const { return offset_ + steady(); }

 private:
  static Timestamp steady() {
    return std::chrono::duration_cast<std::chrono::microseconds>(
               std::chrono::steady_clock::now().time_since_epoch())
        .count();
  }
  Timestamp offset_;
};

}  // namespace ortung
