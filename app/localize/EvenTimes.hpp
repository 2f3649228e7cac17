#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "ortung/base/Time.hpp"

namespace ortung::app {

/// Even times at which a pose is requested, while the readings of a source go by. Not thread-safe.
class EvenTimes {
 public:
  /// @param rate [Hz], in [0.01, 1000]
  explicit EvenTimes(double rate) : period_(1e6 / rate) {}

  /// Returns those before @p stamp that were not returned before; the first one is the first stamp.
  /// If time goes back, they begin anew. In gaps of more than a minute there are none.
  std::vector<Timestamp> before(Timestamp stamp);

 private:
  Timestamp at(std::int64_t index) const;

  double period_;  ///< time between two of them [us]
  std::optional<Timestamp> first_;
  Timestamp last_ = 0;     ///< newest stamp
  std::int64_t next_ = 0;  ///< index of the next time
};

}  // namespace ortung::app
