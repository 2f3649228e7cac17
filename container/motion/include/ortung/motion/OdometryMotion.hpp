#pragma once

#include <memory>

#include "ortung/base/Parameters.hpp"
#include "ortung/motion/MotionModel.hpp"

namespace ortung {

/// The odometry motion model (Thrun, Burgard, Fox, "Probabilistic Robotics", table 5.6): a change
/// of pose is turn, way, turn, each with noise. Where the book lets sigma grow with way and turn,
/// we let the variance grow: so the noise of a way is the same in however many pieces it is
/// followed, and readings may come at any rate.
struct OdometryNoise {          // standard deviations
  double turnPerTurn = 0.2;     ///< `turn_per_turn`: of a turn, after turning 1 rad [rad]
  double turnPerMetre = 0.1;    ///< `turn_per_m`: of a turn, after driving 1 m [rad]
  double wayPerMetre = 0.1;     ///< `way_per_m`: of a way, after driving 1 m [m]
  double wayPerTurn = 0.03;     ///< `way_per_turn`: of a way, after turning 1 rad [m]
  double floorMetres = 0.003;   ///< `floor_m`: of every step, sideways too [m]
  double floorRadians = 0.002;  ///< `floor_deg`: of every step [rad]
  /// `slip_share`: of samples whose noise is four times that, for wheels that slip and bases that
  /// are held: errors of real robots have longer tails than Gaussians.
  double slipShare = 0.0;

  /// @throws std::invalid_argument
  ORTUNG_API void check() const;
  /// Reads [motion] of a robot file, which may hold nothing else. @throws ConfigError
  ORTUNG_API static OdometryNoise read(const Parameters& motion);
};

/// What odometry gets wrong always in the same way.
struct OdometryCorrection {
  double wayScale = 1.0;          ///< `way_scale`: true way of what odometry says
  double turnScale = 1.0;         ///< `turn_scale`: true turn of what odometry says
  double turnBiasPerMetre = 0.0;  ///< `turn_bias_deg_per_m`: to be added to turns [rad/m]
  double wayBiasPerRadian =
      0.0;             ///< `way_bias_m_per_rad`: to be added to ways [m/rad], at most half
                       ///< of the way: e.g. below 0 for a base that slows down in curves
  double delay = 0.0;  ///< `delay_s`: odometry is ahead of the robot [s]

  /// The true change of pose that odometry stands for.
  ORTUNG_API Pose2 apply(const Pose2& odometryChange) const;
  /// Reads the keys of [motion]. @throws ConfigError
  ORTUNG_API static OdometryCorrection read(const Parameters& motion);
};

/// Turn, way, turn: fits all robots that drive where they face, and serves others, too.
/// Not thread-safe, but sampleMotion() may be called by several threads at once.
class ORTUNG_API OdometryMotion : public MotionModel {
 public:
  explicit OdometryMotion(const OdometryNoise& noise = {},
                          const OdometryCorrection& correction = {});
  /// Reads [motion]; `plugin` says which plugin it is for and is of no concern here.
  explicit OdometryMotion(const Parameters& motion);
  ~OdometryMotion() override;

  void sampleMotion(const MovableSamples& samples, const Pose2& odometryChange, std::uint64_t seed,
                    std::uint64_t stream, std::uint64_t first) const override;
  void learnMotion(const Pose2& odometryChange, const Pose2& trueChange) override;
  void endDrive() override;
  /// The most likely noise and correction but for floors and delay; what the pairs say nothing
  /// about stays as it is. A correction that could be chance is none.
  double endLearning() override;
  Parameters settings() const override;

  const OdometryNoise& noise() const { return noise_; }
  const OdometryCorrection& correction() const { return correction_; }

 private:
  struct Learning;
  OdometryNoise noise_;
  OdometryCorrection correction_;
  std::unique_ptr<Learning> learning_;
};

}  // namespace ortung
