#pragma once

#include <cstddef>
#include <deque>

#include "ortung/base/Export.hpp"
#include "ortung/base/Time.hpp"

namespace ortung {

/// Tells a clock that was set back from readings that are held up, by what follows: behind a clock
/// that was set, all readings are late by the same time; in a queue that fills or empties, they
/// come later and later, or less and less late. Compared are the least differences of the four
/// quarters of a span of time, because delays make single readings later, never earlier; halves
/// would be equal when a queue is as long as it was while it filled. It has no clock: times are
/// passed in. Not thread-safe.
class ORTUNG_API SteadyDelay {
 public:
  /// Forgets all readings.
  void clear() { least_.clear(); }
  /// Notes a late reading. @param difference its arrival minus its device time [us]
  /// @return whether isSteadyFor() may be another: it looks at tenths of a second
  bool note(Timestamp arrival, double difference);
  /// Returns whether the difference has been the same for @p span seconds or more.
  bool isSteadyFor(double span) const;

 private:
  struct Least {
    Timestamp begin;    ///< arrival of the first reading of a tenth of a second
    double difference;  ///< least one of that time [us]
  };
  bool isSteadyFrom(std::size_t first) const;

  std::deque<Least> least_;
};

}  // namespace ortung
