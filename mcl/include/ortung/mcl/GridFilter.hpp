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
  double cell = 0.1;                        ///< edge [m], in [0.01, 10]
  double headingStep = 0.0872664625997165;  ///< about; a whole number of them is a turn [rad]
  std::size_t mostBytes = 2'000'000'000;    ///< of memory

  /// @throws std::invalid_argument naming the field, its value and the range
  ORTUNG_API void check() const;
};

/// Markov localization over all poses of a grid (Fox, Burgard, Thrun, "Markov localization for
/// mobile robots in dynamic environments", JAIR 11, 1999): eqs. 6 to 8 of the paper without
/// samples, on the container's interface alone like Mcl. It is what MCL's samples should come near
/// to, thousands of times as slow: a reference for small fields. Of the motion model it takes mean
/// and covariance of each change; it has neither recovery nor polishing, and knows nothing finer
/// than its cells. Not thread-safe.
class ORTUNG_API GridFilter {
 public:
  /// @param config which readings are news, and bins of places; as of Mcl
  /// @param region where the robot can stand; the grid covers all of it
  /// @throws std::invalid_argument for settings that make no sense, or if the grid would take more
  ///   than GridConfig::mostBytes, saying how large it is
  GridFilter(const MclConfig& config, const GridConfig& grid, const FieldRegion& region,
             std::unique_ptr<MotionModel> motion);
  ~GridFilter();
  GridFilter(const GridFilter&) = delete;
  GridFilter& operator=(const GridFilter&) = delete;

  /// Unknown start: evenly over all poses where the robot can stand.
  void startGlobal();
  /// Known start with standard deviations [m], [rad]; none is finer than the cells.
  /// @throws std::invalid_argument if that is off the grid
  void startAt(const Pose2& pose, double sigmaPosition, double sigmaHeading);

  /// As of Mcl: moves the belief by odometry up to each new reading (eq. 8) and weighs it (eq. 7).
  /// Returns whether it was weighed.
  bool update(const SensorContainer& container);
  void followOdometry(const SensorContainer& container);

  /// As of the newest reading that was weighed; status and quality are those of share and
  /// covariance.
  const PoseEstimate& estimate() const;
  /// Carried on by odometry. Nothing before the first reading.
  std::optional<PoseEstimate> estimate(Timestamp stamp) const;
  bool hasOdometry() const;
  /// The belief: centres of all cells with a share above 1e-9, weighted.
  SampleSet cells() const;

  /// Kullback-Leibler divergence of a sample set from the belief, sum of q ln(q / p) over the bins
  /// of places (MclConfig) that samples are in [nats]. What p leaves out counts as 1e-9. Of n
  /// independent samples it is about half their bins / n.
  double divergenceOf(const SampleSet& samples) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ortung
