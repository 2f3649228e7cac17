#pragma once

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
#include "ortung/mcl/MclConfig.hpp"
#include "ortung/mcl/PoseEstimate.hpp"
#include "ortung/mcl/SampleSet.hpp"
#include "ortung/motion/MotionModel.hpp"
#include "ortung/tables/FieldRegion.hpp"

namespace ortung {

/// Monte Carlo localization (paper, section 5.2) on the container's interface alone: it knows
/// neither sensors nor where their readings come from. Not thread-safe, const functions neither.
/// The container may be filled by other threads meanwhile: update() holds its read lock only while
/// it takes what is new, not while it computes.
class ORTUNG_API Mcl {
 public:
  /// @param region where the robot can stand
  /// @throws std::invalid_argument if that is nowhere, or for a configuration that makes no sense
  Mcl(const MclConfig& config, FieldRegion region, std::unique_ptr<MotionModel> motion);
  ~Mcl();
  Mcl(const Mcl&) = delete;
  Mcl& operator=(const Mcl&) = delete;

  /// Unknown start: the whole region is searched for where the first readings fit. That may take
  /// some updates (MclConfig::budgetMs); until then there is no estimate.
  void startGlobal();
  /// Known start with standard deviations [m], [rad]. Whether the robot can stand there is not
  /// asked.
  void startAt(const Pose2& pose, double sigmaPosition, double sigmaHeading);

  // While it runs: unlike a start, these keep what is known of time and odometry. What was weighed
  // within the last half second counts again.

  /// Somebody else knows where the robot is now, that is at the newest odometry that was looked at.
  /// @param covariance may be singular
  /// @throws std::invalid_argument saying what is wrong, if the pose is not finite or that is no
  ///   covariance; the belief stays then
  void setPose(const Pose2& pose, const PoseCovariance& covariance);
  /// The robot may be anywhere: the next readings say where, as of a global start.
  void relocalize();
  /// The belief, moved to the newest odometry. Nothing while a global start waits for its first
  /// reading, or searches.
  std::optional<Belief> belief() const;
  /// Goes on with a belief of an earlier run. Odometry may have begun anew since; the robot is
  /// taken to have stayed where it was.
  /// @throws std::invalid_argument as Belief::check(); the present belief stays then
  void restore(const Belief& belief);

  /// Looks at the container: moves the samples by what odometry says up to the newest reading
  /// (eq. 8), and weighs them by every feature that is newer than the last update (eq. 7).
  /// Returns whether the belief was weighed, i.e. whether there is a new estimate.
  bool update(const SensorContainer& container);

  /// Whether there is a search of the field that is spread over updates: a global start, or for
  /// other places where the robot may be (MclConfig::budgetMs).
  bool isSearching() const;
  /// Goes on with it as an update() without anything new does: for whoever has time between two
  /// readings.
  void searchOn();

  /// Takes odometry alone, so that estimate(stamp) knows of it before the next update().
  void followOdometry(const SensorContainer& container);

  /// As of the newest reading that was weighed, which `stamp` tells: it may be long ago. All zero
  /// before the first one. While a global start waits or searches, its reason is kSearching.
  const PoseEstimate& estimate() const;
  /// As of @p stamp: the belief carried on by odometry, as the newest update() or followOdometry()
  /// saw it. Later than that, the robot is taken to keep its velocities for 0.3 s and to stand
  /// then. May be asked at any time, costs nothing to speak of while the robot stands, and does not
  /// change the filter.
  /// @returns nothing while a global start waits for its first reading, or searches
  std::optional<PoseEstimate> estimate(Timestamp stamp) const;
  /// The places that the belief is spread over, as of the samples now, heaviest first: clusters
  /// with a share of @p least at least, each with its covariance. Status and quality are those of
  /// the whole. Nothing while a global start waits for its first reading, or searches.
  std::vector<PoseEstimate> places(double least = 0.01) const;
  /// Whether there is odometry; without, samples drift (MclConfig::driftMetres).
  bool hasOdometry() const;
  const SampleSet& samples() const;
  /// What devices that read distances or bearings get wrong always in the same way, as far as it
  /// was learned since the last start (MclConfig::learnsBiases), by "model/type" of their features.
  std::map<std::string, DeviceBias> biases() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ortung
