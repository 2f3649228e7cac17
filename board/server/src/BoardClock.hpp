#pragma once

#include <algorithm>
#include <limits>
#include <mutex>

#include "ortung/base/Time.hpp"

namespace ortung::server {

/// The clock in which readings are stamped, as it runs on between two cycles. Thread-safe.
class BoardClock {
 public:
  /// From the moment @p wall on it shows @p stamp and runs @p rate times as fast as wall time.
  /// @param latest where it stands still, so that a world that is held up is not left behind
  void set(Timestamp stamp, Timestamp wall, double rate,
           Timestamp latest = std::numeric_limits<Timestamp>::max()) {
    const std::lock_guard lock(mutex_);
    stamp_ = stamp;
    wall_ = wall;
    rate_ = rate;
    latest_ = latest;
  }
  /// Lets it run on until @p latest.
  void permit(Timestamp latest) {
    const std::lock_guard lock(mutex_);
    latest_ = latest;
  }
  Timestamp at(Timestamp wall) const {
    const std::lock_guard lock(mutex_);
    const auto gone = static_cast<Timestamp>(static_cast<double>(wall - wall_) * rate_);
    return std::min(stamp_ + gone, std::max(stamp_, latest_));
  }

 private:
  mutable std::mutex mutex_;
  Timestamp stamp_ = 0;
  Timestamp wall_ = 0;  ///< [us] on the computer's clock
  double rate_ = 0.0;   ///< speed relative to wall time; 0: the clock stands still
  Timestamp latest_ = std::numeric_limits<Timestamp>::max();
};

/// The computer's clock, which never goes back [us].
Timestamp wallTime();

}  // namespace ortung::server
