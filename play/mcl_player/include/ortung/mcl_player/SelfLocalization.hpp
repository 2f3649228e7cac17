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

/// MCL for a player, on the readings of its own robot, with the robot file's [mcl] and [motion].
/// The same in the simulator, and as a client that was given tables. What comes out is a function
/// of the readings and of the seat's chance when it was made: the same bits from the same seed.
/// Not thread-safe.
///
///     void begin(PlayerSeat& seat) override { self_.emplace(seat); }
///     bool needsTables() const override { return true; }
///     bool senseAndAct(PlayerSeat& seat) override {
///       self_->update(seat);
///       if (const auto here = self_->estimate(seat.now())) ...
class ORTUNG_API SelfLocalization {
 public:
  /// The robot may be anywhere: the first readings say where.
  /// @param seat as in Player::begin(); one number of its chance is taken
  /// @throws std::runtime_error for a robot without tables, or without a feature that localizes;
  ///   ConfigError, PluginError, std::invalid_argument for its settings
  explicit SelfLocalization(PlayerSeat& seat);
  ~SelfLocalization();
  SelfLocalization(const SelfLocalization&) = delete;
  SelfLocalization& operator=(const SelfLocalization&) = delete;

  /// Begins anew, anywhere.
  void startGlobal();
  /// Begins anew at a pose that is known so well: standard deviations [m], [rad].
  void startAt(const Pose2& pose, double sigmaPosition, double sigmaHeading);
  /// The same by somebody who has seen where the robot really is, and is as wrong as he says.
  void startNear(const Pose2& truth, double sigmaPosition, double sigmaHeading, Random& random);
  /// Somebody has carried the robot and says where, while it plays: see Mcl::setPose().
  /// @param covariance row-major, of (x [m], y [m], theta [rad])
  /// @throws std::invalid_argument
  void setPose(const Pose2& pose, const PoseCovariance& covariance);

  /// Takes what is new in the robot's container; once in each cycle in which the player acts.
  /// @returns whether readings have weighed the belief
  bool update(PlayerSeat& seat);
  /// The belief carried on by odometry to @p stamp; nothing before there is one. See
  /// Mcl::estimate().
  std::optional<PoseEstimate> estimate(Timestamp stamp) const { return mcl_->estimate(stamp); }

  const Mcl& mcl() const { return *mcl_; }

 private:
  std::unique_ptr<Mcl> mcl_;
};

}  // namespace ortung
