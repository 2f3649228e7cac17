#pragma once

#include "ortung/container/MotionModel.hpp"
#include "ortung/container/Parameters.hpp"

namespace ortung {

/// The odometry motion model (Thrun, Burgard, Fox, "Probabilistic Robotics", table 5.6): a change
/// of pose is turn, way, turn, each with noise. Sigmas add up in quadrature.
struct OdometryNoise {
  double turnPerTurn = 0.1;    ///< `turn_per_turn`: sigma of a turn by turning [rad/rad]
  double turnPerMetre = 0.1;   ///< `turn_per_m`: sigma of a turn by driving [rad/m]
  double wayPerMetre = 0.1;    ///< `way_per_m`: sigma of a way by driving [m/m]
  double wayPerTurn = 0.05;    ///< `way_per_turn`: sigma of a way by turning [m/rad]
  double floorMetres = 0.003;  ///< `floor_m`: sigma of every step, sideways too [m]
  double floorRadians = 0.002; ///< `floor_deg`: sigma of every step [rad]

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
