#pragma once

#include "Rules.hpp"

namespace ortung::soccer {

/// Counts halves and their time.
class MatchClock {
 public:
  explicit MatchClock(const Rules::Match& rules) : rules_(rules) {}

  int half() const { return half_; }     ///< current half from 1; 0: the game has not begun
  double time() const { return time_; }  ///< time of this half [s]
  double length() const;                 ///< length of this half [s]
  bool isOvertime() const { return half_ > rules_.halves; }
  bool isHalfOver() const { return time_ >= length() - 1e-9; }
  /// Returns whether another half follows this one.
  bool hasNext(bool isDraw) const;

  void begin(int half);
  void advance(double seconds);
  bool stopsWithBall() const { return rules_.clockStops; }

 private:
  Rules::Match rules_;
  int half_ = 0;
  double time_ = 0.0;
};

}  // namespace ortung::soccer
