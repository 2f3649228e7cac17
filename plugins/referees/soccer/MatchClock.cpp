#include "MatchClock.hpp"

#include <algorithm>

namespace ortung::soccer {

double MatchClock::length() const { return isOvertime() ? rules_.overtimeHalf : rules_.half; }

bool MatchClock::hasNext(bool isDraw) const {
  if (half_ < rules_.halves) return true;
  const bool isBetweenOvertimes = half_ > rules_.halves;
  return half_ < rules_.halves + rules_.overtimeHalves && (isDraw || isBetweenOvertimes);
}

void MatchClock::begin(int half) {
  half_ = half;
  time_ = 0.0;
}

void MatchClock::advance(double seconds) { time_ = std::min(time_ + seconds, length()); }

}  // namespace ortung::soccer
