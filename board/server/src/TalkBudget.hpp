#pragma once

#include <algorithm>

#include "ortung/base/Time.hpp"

namespace ortung::server {

/// How much somebody may still say: lines and bytes grow back with time, to what a second gives.
/// The last thing said may cost more than is left; the debt has to be waited for.
class TalkBudget {
 public:
  /// @param lines, bytes a second
  /// @param share of a second that is there at the beginning
  TalkBudget(double lines, double bytes, double share = 1.0)
      : mostLines_(lines), mostBytes_(bytes), lines_(lines * share), bytes_(bytes * share) {}

  /// How long it takes until something may be said [s]; 0: now.
  double wait(Timestamp now) {
    grow(now);
    return std::max({0.0, -lines_ / mostLines_, -bytes_ / mostBytes_});
  }
  void spend(double lines, double bytes) {
    lines_ -= lines;
    bytes_ -= bytes;
  }

 private:
  void grow(Timestamp now) {
    const double gone = now_ == 0 ? 0.0 : toSeconds(now - now_);
    now_ = now;
    lines_ = std::min(mostLines_, lines_ + gone * mostLines_);
    bytes_ = std::min(mostBytes_, bytes_ + gone * mostBytes_);
  }

  double mostLines_;
  double mostBytes_;
  double lines_;
  double bytes_;
  Timestamp now_ = 0;  ///< time of the last call [us]; 0: never
};

}  // namespace ortung::server
