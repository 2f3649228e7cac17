#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "ortung/base/Parameters.hpp"
#include "ortung/motion/MotionModel.hpp"
#include "ortung/motion/MotionMoments.hpp"

namespace ortung {

/// The odometry motion model (Thrun, Burgard, Fox, "Probabilistic Robotics", table 5.6): a change
/// of pose is turn, distance, turn, each with noise. Where the book lets sigma grow with distance
/// and turn, we let the variance grow: so the noise of a path does not depend on the number of
/// pieces that it is followed in, and readings may come at any rate.
struct OdometryNoise {          // standard deviations
  double turnPerTurn = 0.2;     ///< `turn_per_turn`: noise of a turn after turning 1 rad [rad]
  double turnPerMetre = 0.1;    ///< `turn_per_m`: noise of a turn after driving 1 m [rad]
  double wayPerMetre = 0.1;     ///< `way_per_m`: noise of a distance after driving 1 m [m]
  double wayPerTurn = 0.03;     ///< `way_per_turn`: noise of a distance after turning 1 rad [m]
  double floorMetres = 0.003;   ///< `floor_m`: noise of every step, sideways, too [m]
  double floorRadians = 0.002;  ///< `floor_deg`: noise of every step [rad]
  /// `slip_share`: share of samples whose noise is four times as large, in [0, 0.5], for wheels
  /// that slip and bases that are held: errors of real robots have longer tails than Gaussians.
  double slipShare = 0.0;
  static constexpr float kSlip = 4.0F;  ///< factor of the noise of samples that slip

  /// Returns the share of samples that slip: one of a whole number of them, or 0.
  ORTUNG_API double slips() const;
  /// Calls @p enlarge with the index of each sample that slips, evenly picked.
  /// @param first index of the first of these samples in its set
  /// @param n number of samples
  template <typename Enlarge>
  void forEachSlip(std::uint64_t first, std::size_t n, Enlarge enlarge) const {
    const std::uint64_t period = slipPeriod();
    if (period == 0) return;
    for (std::uint64_t i = (period - first % period) % period; i < n; i += period) enlarge(i);
  }

  /// @throws std::invalid_argument if a value is out of its range
  ORTUNG_API void check() const;
  /// Reads [motion] of a robot file, which may hold nothing else. @throws ConfigError
  ORTUNG_API static OdometryNoise read(const Parameters& motion);

 private:
  /// Returns the number of samples of which one slips, 0 if none does.
  ORTUNG_API std::uint64_t slipPeriod() const;
};

/// The systematic error of odometry.
struct OdometryCorrection {
  double wayScale = 1.0;          ///< `way_scale`: true distance / odometry's distance
  double turnScale = 1.0;         ///< `turn_scale`: true turn / odometry's turn
  double turnBiasPerMetre = 0.0;  ///< `turn_bias_deg_per_m`: turn added per distance [rad/m]
  /// `way_bias_m_per_rad`: distance added per turn [m/rad], at most half of the distance; e.g.
  /// below 0 for a base that slows down in curves.
  double wayBiasPerRadian = 0.0;
  double delay = 0.0;  ///< `delay_s`: time by which odometry is ahead of the robot [s]

  /// Returns the corrected change of pose, in the robot's old frame.
  ORTUNG_API Pose2 apply(const Pose2& odometryChange) const;
  /// Reads the keys of [motion]. @throws ConfigError
  ORTUNG_API static OdometryCorrection read(const Parameters& motion);
};

/// Returns mean and covariance of what OdometryMotion::sampleMotion() makes of a change. Turns
/// don't wrap: those of large noise have a variance of more than half a turn.
/// @param odometryChange motion in the robot's old frame
ORTUNG_API MotionChange expectedChange(const OdometryNoise& noise,
                                       const OdometryCorrection& correction,
                                       const Pose2& odometryChange);

/// The motion model of turn, distance, turn: it fits all robots that drive where they face, and
/// serves others, too.
/// Not thread-safe, but sampleMotion() may be called by several threads at once.
class ORTUNG_API OdometryMotion : public MotionModel {
 public:
  explicit OdometryMotion(const OdometryNoise& noise = {},
                          const OdometryCorrection& correction = {});
  /// Reads [motion]; its key `plugin` is ignored here.
  explicit OdometryMotion(const Parameters& motion);
  ~OdometryMotion() override;

  void sampleMotion(const MovableSamples& samples, const Pose2& odometryChange, std::uint64_t seed,
                    std::uint64_t stream, std::uint64_t first) const override;
  void learnMotion(const Pose2& odometryChange, const Pose2& trueChange) override;
  void endDrive() override;
  /// Finds the most likely noise and correction, except floors and delay; settings that the pairs
  /// do not determine stay as they are. A correction that could be random is left out.
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
