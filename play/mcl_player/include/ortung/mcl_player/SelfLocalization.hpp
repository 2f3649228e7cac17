#pragma once

#include <memory>
#include <optional>

#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/base/PoseCovariance.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/base/Time.hpp"
#include "ortung/mcl/Mcl.hpp"
#include "ortung/mcl/PoseEstimate.hpp"
#include "ortung/sim_api/Player.hpp"

namespace ortung {

/// MCL for a player, on the readings of its own robot, with the robot file's [mcl] and [motion]. It
/// is the same in the simulator and in a client that was given tables. Estimates are a function of
/// the readings and of the seat's random generator at construction: the same seed gives the same
/// bits. Not thread-safe.
///
///     void begin(PlayerSeat& seat) override { self_.emplace(seat); }
///     bool needsTables() const override { return true; }
///     bool senseAndAct(PlayerSeat& seat) override {
///       self_->update(seat);
///       if (const auto here = self_->estimate(seat.now())) ...
class ORTUNG_API SelfLocalization {
 public:
  /// Begins global localization: the robot may be anywhere.
  /// @param seat as in Player::begin(); two numbers of its random generator are taken
  /// @throws std::runtime_error for a robot without tables, or without a feature that localizes;
  ///   ConfigError, PluginError, std::invalid_argument for its settings
  explicit SelfLocalization(PlayerSeat& seat);
  /// Begins near the true pose, as startNear() with the seat's random generator, without the
  /// preparations of global localization. @throws as above
  SelfLocalization(PlayerSeat& seat, const Pose2& truth, double sigmaPosition, double sigmaHeading);
  ~SelfLocalization();
  SelfLocalization(const SelfLocalization&) = delete;
  SelfLocalization& operator=(const SelfLocalization&) = delete;

  /// Restarts global localization: the robot may be anywhere.
  void startGlobal();
  /// Restarts at a pose that is known with these standard deviations [m], [rad].
  void startAt(const Pose2& pose, double sigmaPosition, double sigmaHeading);
  /// Restarts near the true pose: at a pose with random errors of these standard deviations [m],
  /// [rad].
  void startNear(const Pose2& truth, double sigmaPosition, double sigmaHeading, Random& random);
  /// Sets the pose of a robot that was carried while it plays: see Mcl::setPose().
  /// @param covariance row-major covariance of (x [m], y [m], theta [rad])
  /// @throws std::invalid_argument
  void setPose(const Pose2& pose, const PoseCovariance& covariance);

  /// Processes the new readings in the robot's container; to be called once in each cycle in which
  /// the player acts. @returns whether readings have changed the belief
  bool update(PlayerSeat& seat);
  /// Returns the belief, extrapolated by odometry to @p stamp; nothing before there is one. See
  /// Mcl::estimate().
  std::optional<PoseEstimate> estimate(Timestamp stamp) const { return mcl_->estimate(stamp); }

  /// Returns the filter.
  const Mcl& mcl() const { return *mcl_; }

 private:
  std::unique_ptr<Mcl> mcl_;
};

}  // namespace ortung
