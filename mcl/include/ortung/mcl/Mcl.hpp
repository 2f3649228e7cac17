#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ortung/base/Pose2.hpp"
#include "ortung/base/PoseCovariance.hpp"
#include "ortung/core/Correctable.hpp"
#include "ortung/core/SensorContainer.hpp"
#include "ortung/mcl/Belief.hpp"
#include "ortung/mcl/MapChanges.hpp"
#include "ortung/mcl/MclConfig.hpp"
#include "ortung/mcl/OdometryErrors.hpp"
#include "ortung/mcl/PoseEstimate.hpp"
#include "ortung/mcl/SampleSet.hpp"
#include "ortung/motion/MotionModel.hpp"
#include "ortung/tables/FieldRegion.hpp"

namespace ortung {

/// Monte Carlo localization (paper, section 5.2) on the container's interface alone: it knows
/// neither sensors nor where their readings come from. Not thread-safe, not even its const
/// functions. Other threads may fill the container meanwhile: update() holds its read lock only
/// while it takes new readings, not while it computes.
class ORTUNG_API Mcl {
 public:
  /// @param config settings, which are checked
  /// @param region where the robot can stand
  /// @param motion motion model of the robot
  /// @throws std::invalid_argument if the robot can stand nowhere, or for a configuration that
  /// makes
  ///   no sense
  Mcl(const MclConfig& config, FieldRegion region, std::unique_ptr<MotionModel> motion);
  ~Mcl();
  Mcl(const Mcl&) = delete;
  Mcl& operator=(const Mcl&) = delete;

  /// Starts without a known pose: searches the whole region for poses that fit the first readings.
  /// That may take some updates (MclConfig::budgetMs); until then there is no estimate.
  void startGlobal();
  /// Starts at a known pose in the field frame with standard deviations [m], [rad]. It is not
  /// checked whether the robot can stand there.
  void startAt(const Pose2& pose, double sigmaPosition, double sigmaHeading);

  // The next functions are for a running filter: unlike a start, they keep what is known of time
  // and odometry. Readings that were weighed within the last half second count again.

  /// Sets the belief to a pose that the caller knows, at the time of the newest odometry that was
  /// taken.
  /// @param pose pose in the field frame
  /// @param covariance covariance of the pose in the field frame; it may be singular
  /// @throws std::invalid_argument saying what is wrong, if the pose is not finite or @p covariance
  ///   is no covariance; the belief stays then
  void setPose(const Pose2& pose, const PoseCovariance& covariance);
  /// Forgets the place: the next readings find it anew, as after startGlobal().
  void relocalize();
  /// Returns the belief, moved to the newest odometry; nothing while a global start waits for its
  /// first reading, or searches.
  std::optional<Belief> belief() const;
  /// Restores the belief of an earlier run. Odometry may have begun anew since; the robot is
  /// assumed not to have moved since then.
  /// @throws std::invalid_argument as Belief::check(); the present belief stays then
  void restore(const Belief& belief);

  /// Takes new readings from the container: moves the samples by what odometry says up to the
  /// newest reading (eq. 8), and weighs them by every feature that is newer than the last update
  /// (eq. 7). Returns whether the belief was weighed, i.e. whether there is a new estimate.
  bool update(const SensorContainer& container);

  /// Makes each update() end within MclConfig::budgetMs by a clock. Searches stop after a few poses
  /// once their time is over, and go on in the next update; annealing ends early, rivals wait, and
  /// if there is not even time to weigh all samples, an evenly spread part of them stays. As long
  /// as the time suffices, the result is the same as without a clock. Without one, which is the
  /// default, times are nominal, and a replay does the same.
  /// @param milliseconds time that only goes forwards [ms]; null: no clock
  void keepTime(std::function<double()> milliseconds);

  /// Returns whether a search of the field is going on, which is spread over updates: a global
  /// start, or a search for alternative places (MclConfig::budgetMs).
  bool isSearching() const;
  /// Continues the search like an update() without new readings, for callers that have time between
  /// two readings.
  void searchOn();

  /// Takes odometry only, so that estimate(stamp) includes it before the next update().
  void followOdometry(const SensorContainer& container);

  /// Returns the estimate at the newest reading that was weighed; its `stamp` may be long ago. All
  /// numbers are zero before the first one. While a global start waits or searches, its reason is
  /// kSearching.
  const PoseEstimate& estimate() const;
  /// Returns the estimate at @p stamp: the belief predicted by the odometry of the newest update()
  /// or followOdometry(). Beyond that, the robot is assumed to keep its velocities for 0.3 s and
  /// then to be stationary. It may be called at any time, is cheap while the robot is stationary,
  /// and does not change the filter.
  /// @returns nothing while a global start waits for its first reading, or searches
  std::optional<PoseEstimate> estimate(Timestamp stamp) const;
  /// Returns the places over which the belief is spread, by the present samples, heaviest first:
  /// clusters with a share of at least @p least, in [0, 1], each with its covariance. Status and
  /// quality are those of the whole belief. It is empty while a global start waits for its first
  /// reading, or searches.
  std::vector<PoseEstimate> places(double least = 0.01) const;
  /// Returns the share of each floor of the building, in its order and of sum 1: of the present
  /// samples, or of places that look like the estimate's, if that is greater. Between floors that
  /// look the same, samples gather on one of them by chance; those places stay until readings have
  /// ruled them out. It is empty in a field that is no building, and all 0 without samples.
  std::vector<double> floorShares() const;
  /// Returns whether there is odometry; without it, process noise moves samples
  /// (MclConfig::driftMetres).
  bool hasOdometry() const;
  /// Returns the present samples, field frame.
  const SampleSet& samples() const;
  /// Returns the systematic errors of devices that read distances or bearings, as learned since the
  /// last start (MclConfig::learnsBiases), by "model/type" of their features.
  std::map<std::string, DeviceBias> biases() const;
  /// Returns odometry's errors, as learned so far (MclConfig::learnsOdometry); none as long as
  /// nothing was learned.
  OdometryErrors odometryErrors() const;
  /// Returns where readings have found the world otherwise than it was learned
  /// (MclConfig::watchesMap); it outlives beliefs.
  MapChanges mapChanges() const;
  /// Restores what an earlier run has found out about the map.
  /// @throws std::invalid_argument as MapChanges::check(); what is known stays then
  void restore(const MapChanges& changes);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ortung
