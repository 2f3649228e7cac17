#pragma once

#include "ortung/base/Export.hpp"
#include "ortung/base/Time.hpp"
#include "ortung/mcl/SampleSet.hpp"

namespace ortung {

/// The filter's posterior at one time, to be saved and restored.
struct ORTUNG_API Belief {
  Timestamp stamp = 0;  ///< time of the samples [us], in the clock of the readings
  SampleSet samples;    ///< weighted samples of the pose, field frame

  /// Checks the samples.
  /// @throws std::invalid_argument naming the wrong sample or array: arrays of different sizes, no
  ///   samples or more than 5,000,000, poses that are not finite or farther than 1e6 m away,
  ///   weights that are NaN or +infinity, or all of them zero
  void check() const;
};

}  // namespace ortung
