#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "ortung/base/Time.hpp"

namespace ortung::app {

/// The even times at which a pose is asked for, as the moments of a source go by. Not thread-safe.
class EvenTimes {
 public:
  /// @param rate [Hz], in [0.01, 1000]
  explicit EvenTimes(double rate) : period_(1e6 / rate) {}

  /// Those before @p stamp that were not given before; the first one is the first moment's. Where
  /// time went back, they begin anew there. Within more than a minute without a moment nobody is
  /// asked.
  std::vector<Timestamp> before(Timestamp stamp);

 private:
  Timestamp at(std::int64_t index) const;

  double period_;  ///< [us]
  std::optional<Timestamp> first_;
  Timestamp last_ = 0;     ///< newest moment
  std::int64_t next_ = 0;  ///< index of the next time
};

}  // namespace ortung::app
