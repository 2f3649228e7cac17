#pragma once

#include <chrono>

#include "ortung/base/Time.hpp"

namespace ortung {

/// Time of day when it was made, and the time since then: it is not set while a robot runs.
/// Thread-safe; copies tell the same time.
class HostClock {
 public:
  HostClock()
      : offset_(std::chrono::duration_cast<std::chrono::microseconds>(
                    std::chrono::system_clock::now().time_since_epoch())
                    .count() -
                steady()) {}
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
