#pragma once

#include <utility>

#include "TalkBudget.hpp"

namespace ortung::server {

/// A share of a processor for some work: who has taken more has to wait. What is not taken is kept
/// for up to a second.
class ProcessorShare {
 public:
  /// @param share in (0, 1]
  explicit ProcessorShare(double share) : budget_(share, 1.0) {}

  /// @param used processor time of all work so far [s] @param now on the computer's clock
  /// @returns how long to wait before any more of it [s]
  double charge(double used, Timestamp now) {
    budget_.spend(used - std::exchange(charged_, used), 0.0);
    return budget_.wait(now);
  }

 private:
  TalkBudget budget_;     ///< what it counts as lines are seconds of a processor
  double charged_ = 0.0;  ///< processor time that was paid for [s]
};

}  // namespace ortung::server
