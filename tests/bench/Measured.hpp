#pragma once

#include <time.h>

#include <algorithm>

namespace ortung::bench {

inline constexpr double kCycle = 0.01;   // [s]
inline constexpr int kCyclesAScan = 10;  // 10 Hz
inline constexpr int kRounds = 5;  // the fastest counts, since other programs run on the machine

inline double computingTime() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Simulated seconds a second of computing time, of the fastest round.
/// @param seconds how long it is measured at least [s]
/// @param step called with the number of the cycle
template <class Step>
double measure(double seconds, const Step& step) {
  double best = 0.0;
  for (int round = 0; round < kRounds; ++round) {
    const double begin = computingTime();
    double elapsed = 0.0;
    int cycles = 0;
    while (elapsed < seconds / kRounds) {
      for (int i = 0; i < kCyclesAScan; ++i) step(cycles++);
      elapsed = computingTime() - begin;
    }
    best = std::max(best, cycles * kCycle / elapsed);
  }
  return best;
}

}  // namespace ortung::bench
