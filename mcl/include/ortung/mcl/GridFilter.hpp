#pragma once

#include <cstddef>
#include <memory>
#include <optional>

#include "ortung/base/Pose2.hpp"
#include "ortung/core/SensorContainer.hpp"
#include "ortung/mcl/MclConfig.hpp"
#include "ortung/mcl/PoseEstimate.hpp"
#include "ortung/mcl/SampleSet.hpp"
#include "ortung/motion/MotionModel.hpp"
#include "ortung/tables/FieldRegion.hpp"

namespace ortung {

/// Settings of the grid filter.
struct GridConfig {
  double cell = 0.1;  ///< edge of a cell [m], in [0.01, 10]
  /// Approximate step between headings [rad], 5 degrees; it is adapted so that it divides a turn.
  double headingStep = 0.0872664625997165;
  std::size_t mostBytes = 2'000'000'000;  ///< most memory that the grid may take [bytes]

  /// Checks the settings.
  /// @throws std::invalid_argument naming the field, its value and the range
  ORTUNG_API void check() const;
};

/// Markov localization over all poses of a grid (Fox, Burgard, Thrun, "Markov localization for
/// mobile robots in dynamic environments", JAIR 11, 1999): eqs. 6 to 8 of the paper on a grid
/// instead of samples, on the container's interface alone like Mcl. It is a reference for small
/// fields, which MCL's samples should approximate, and thousands of times slower. It uses mean and
/// covariance of the motion model's changes. It has neither recovery nor refinement, and resolves
/// nothing finer than its cells. Not thread-safe.
class ORTUNG_API GridFilter {
 public:
  /// @param config settings as for Mcl; those of new readings and of bins are used
  /// @param region where the robot can stand; the grid covers all of it
  /// @param motion motion model of the robot
  /// @throws std::invalid_argument for settings that make no sense, or if the grid would take more
  ///   than GridConfig::mostBytes, saying how large it is
  GridFilter(const MclConfig& config, const GridConfig& grid, const FieldRegion& region,
             std::unique_ptr<MotionModel> motion);
  ~GridFilter();
  GridFilter(const GridFilter&) = delete;
  GridFilter& operator=(const GridFilter&) = delete;

  /// Starts with a uniform belief over all poses where the robot can stand.
  void startGlobal();
  /// Starts at a known pose in the field frame with standard deviations [m], [rad]; none is finer
  /// than the cells.
  /// @throws std::invalid_argument if the pose is outside of the grid
  void startAt(const Pose2& pose, double sigmaPosition, double sigmaHeading);

  /// Moves the belief by odometry up to each new reading (eq. 8) and weighs it (eq. 7), like
  /// Mcl::update(). Returns whether it was weighed.
  bool update(const SensorContainer& container);
  /// Takes odometry only, so that estimate(stamp) includes it before the next update().
  void followOdometry(const SensorContainer& container);

  /// Returns the estimate at the newest reading that was weighed; status and quality follow from
  /// share and covariance alone.
  const PoseEstimate& estimate() const;
  /// Returns the estimate at @p stamp, predicted by odometry; nothing before the first reading.
  std::optional<PoseEstimate> estimate(Timestamp stamp) const;
  /// Returns whether there has been odometry.
  bool hasOdometry() const;
  /// Returns the belief: the centres of all cells with a share above 1e-9, weighted.
  SampleSet cells() const;

  /// Returns the Kullback-Leibler divergence of a sample set from the belief, sum of q ln(q / p)
  /// over the bins of places (MclConfig) that samples are in [nats]. A bin in which p is zero
  /// counts as 1e-9. For n independent samples in k bins it is about k / (2 n).
  double divergenceOf(const SampleSet& samples) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ortung
