#pragma once

#include <span>

#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/base/SampleView.hpp"

namespace ortung {

/// Answer of getProbability(pose) when the sensor expects nothing there (paper, section 5.2).
inline constexpr double kNoExpectation = -1.0;

/// The resolution to which tables round poses.
struct PoseResolution {
  double metres = 0.0;   ///< edge of a cell; 0: they don't round
  double radians = 0.0;  ///< step of directions; 0: they don't round
};

/// The likelihood of one reading at poses. The feature that holds the reading makes it once, and it
/// never changes. It has all that it needs: the reading in the tables' terms and shared ownership
/// of the tables; so samples are weighed without a lock, while the feature takes its next readings.
/// Thread-safe. A plugin with a table of its own implements weigh().
class ORTUNG_API Weigher {
 public:
  Weigher() = default;
  virtual ~Weigher();
  Weigher(const Weigher&) = delete;
  Weigher& operator=(const Weigher&) = delete;

  /// Returns p(s|l) in [0, 1], 1 for a perfect match, or kNoExpectation.
  double getProbability(const Pose2& pose) const;
  /// Weighs a sample set (paper, eq. 7): adds ln p(s|l_i) to logProbability[i]. A sample without
  /// expectation gets the feature's outlier floor, so it never wins against one with a bad
  /// expectation. This is the fast path: one call for a whole set.
  /// @pre poses.size() == logProbability.size()
  void getProbability(const SampleView& poses, std::span<float> logProbability) const;

  /// Returns how far apart poses must be for its tables to distinguish them; by default any
  /// distance is enough.
  virtual PoseResolution resolution() const { return {}; }

 protected:
  /// Returns ln p(s|l) of one pose, NaN for "no expectation"; by default the result of weigh().
  virtual double logProbabilityAt(const Pose2& pose) const;

 private:
  /// Adds ln p(s|l_i), or the outlier floor, to logProbability[i].
  virtual void weigh(const SampleView& poses, std::span<float> logProbability) const = 0;
};

}  // namespace ortung
