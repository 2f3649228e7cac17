#pragma once

#include "ortung/base/Export.hpp"
#include "ortung/base/Time.hpp"
#include "ortung/mcl/SampleSet.hpp"

namespace ortung {

/// All that the filter knows of where the robot is at one time, to be kept and given back.
struct ORTUNG_API Belief {
  Timestamp stamp = 0;  ///< of the samples, in the clock of the readings
  SampleSet samples;

  /// @throws std::invalid_argument saying which sample can't be: arrays of different sizes, no
  ///   samples or more than 5,000,000, poses that are not finite or farther than 1e6 m away,
  ///   weights that are NaN or +infinity, or all of them zero
  void check() const;
};

}  // namespace ortung
