#pragma once

#include <mutex>

#include "ortung/container/Time.hpp"

namespace ortung::server {

/// The clock in which readings are stamped, as it runs on between two cycles. Thread-safe.
class BoardClock {
 public:
  /// From the moment @p wall on it shows @p stamp and runs @p rate times as fast as wall time.
  void set(Timestamp stamp, Timestamp wall, double rate) {
    const std::lock_guard lock(mutex_);
    stamp_ = stamp;
    wall_ = wall;
    rate_ = rate;
  }
  Timestamp at(Timestamp wall) const {
    const std::lock_guard lock(mutex_);
    return stamp_ + static_cast<Timestamp>(static_cast<double>(wall - wall_) * rate_);
  }

 private:
  mutable std::mutex mutex_;
  Timestamp stamp_ = 0;
  Timestamp wall_ = 0;  ///< [us] on the computer's clock
  double rate_ = 0.0;   ///< 0: stands still
};

/// The computer's clock, which never goes back [us].
Timestamp wallTime();

}  // namespace ortung::server
