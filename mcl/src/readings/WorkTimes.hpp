#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "ReadingsTuning.hpp"

namespace ortung {

/// Work of an update whose time is measured, or which may wait.
enum class Work : std::uint8_t {
  // Slices, between which the clock is asked.
  kWeighing,   ///< a part of the belief; its size is its nominal time
  kSearching,  ///< a few poses, or a piece of a choice among them; its size is 1, here and below
  kAnnealing,
  kPolishing,  ///< a step of Gauss-Newton
  // Whole steps that can wait for another update.
  kStart,  ///< the first estimate of a global start
  kMap,    ///< a look at the map; its size is 1
  kUnsure,
  kAround,
  kElsewhere,
  kDrawing,
  kDelays,
  // What follows in any case, in this order; the size is UpdateTime::sizeOf(), of kRefining 1.
  kClusters,
  kLookalikes,  ///< without their comparison, whose poses are weighed and which can wait
  kEstimate,
  kRefining,
  kClosing,
  kResampling,
  kMoment,  ///< a whole moment, without what can wait; its size is its nominal time
  kEnd      ///< the number of them
};

/// How long work of each kind takes: the longest time by its size, lately. Not thread-safe.
class WorkTimes {
 public:
  /// Returns the time to expect for work of this size [ms]; 0 before any was measured.
  double of(Work work, double size = 1.0) const {
    return size * times_[static_cast<std::size_t>(work)].each;
  }
  bool isMeasured(Work work) const { return times_[static_cast<std::size_t>(work)].isMeasured; }
  void took(Work work, double size, double milliseconds) {
    if (!(size > 0.0)) return;
    Time& its = times_[static_cast<std::size_t>(work)];
    const double now = milliseconds / size;
    // A thread that was stopped for a while says little, so a time at most doubles at once.
    const double most = its.each > 0.0 ? tuning::budget::kGrowth * its.each : now;
    its.each = std::max(tuning::budget::kTimeKept * its.each, std::min(now, most));
    its.isMeasured = true;
  }

 private:
  struct Time {
    double each = 0.0;  ///< [ms] by size
    bool isMeasured = false;
  };
  std::array<Time, static_cast<std::size_t>(Work::kEnd)> times_{};
};

}  // namespace ortung
