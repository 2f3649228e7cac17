#pragma once

#include "ortung/container/MotionModel.hpp"
#include "ortung/container/Parameters.hpp"

namespace ortung {

/// The odometry motion model (Thrun, Burgard, Fox, "Probabilistic Robotics", table 5.6): a change
/// of pose is turn, way, turn, each with noise. Where the book lets sigma grow with way and turn, we
/// let the variance grow: so the noise of a way is the same in however many pieces it is followed,
/// and readings may come at any rate.
struct OdometryNoise {  // standard deviations
  double turnPerTurn = 0.2;    ///< `turn_per_turn`: of a turn, after turning 1 rad [rad]
  double turnPerMetre = 0.1;   ///< `turn_per_m`: of a turn, after driving 1 m [rad]
  double wayPerMetre = 0.1;    ///< `way_per_m`: of a way, after driving 1 m [m]
  double wayPerTurn = 0.03;    ///< `way_per_turn`: of a way, after turning 1 rad [m]
  double floorMetres = 0.003;  ///< `floor_m`: of every step, sideways too [m]
  double floorRadians = 0.002; ///< `floor_deg`: of every step [rad]

  /// @throws std::invalid_argument
  ORTUNG_API void check() const;
  /// Reads [motion] of a robot file. @throws ConfigError
  ORTUNG_API static OdometryNoise read(const Parameters& motion);
};

class ORTUNG_API OdometryMotion : public MotionModel {
 public:
  explicit OdometryMotion(const OdometryNoise& noise = {});
  ~OdometryMotion() override;
  void sampleMotion(const MovableSamples& samples, const Pose2& odometryChange, std::uint64_t seed,
                    std::uint64_t stream, std::uint64_t first) const override;

 private:
  OdometryNoise noise_;
};

}  // namespace ortung
