#pragma once

#include <span>

#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/base/SampleView.hpp"

namespace ortung {

/// Answer of getProbability(pose) when the sensor expects nothing there (paper, section 5.2).
inline constexpr double kNoExpectation = -1.0;

/// What tables round poses to.
struct PoseResolution {
  double metres = 0.0;   ///< edge of a cell; 0: they don't round
  double radians = 0.0;  ///< step of directions; 0: they don't round
};

/// What one reading says about poses: made once a reading by the feature that holds it, and never
/// changed after. It has all that it needs, the reading in the tables' terms and a share in the
/// tables; so samples are weighed without a lock, while the feature takes its next readings.
/// Thread-safe. A plugin with a table of its own writes weigh().
class ORTUNG_API Weigher {
 public:
  Weigher() = default;
  virtual ~Weigher();
  Weigher(const Weigher&) = delete;
  Weigher& operator=(const Weigher&) = delete;

  /// p(s|l) in [0, 1], 1 for a perfect match, or kNoExpectation.
  double getProbability(const Pose2& pose) const;
  /// Weighs a sample set (paper, eq. 7): adds ln p(s|l_i) to logProbability[i]. A sample without
  /// expectation gets the feature's outlier floor, so it never wins against one with a bad
  /// expectation. One call a set: the fast path.
  /// @pre poses.size() == logProbability.size()
  void getProbability(const SampleView& poses, std::span<float> logProbability) const;

  /// How far apart poses must be for its tables to tell them apart; by default they tell all.
  virtual PoseResolution resolution() const { return {}; }

 protected:
  /// ln p(s|l) of one pose, NaN for "no expectation"; by default what weigh() says.
  virtual double logProbabilityAt(const Pose2& pose) const;

 private:
  /// Adds ln p(s|l_i) or the outlier floor.
  virtual void weigh(const SampleView& poses, std::span<float> logProbability) const = 0;
};

}  // namespace ortung
