#pragma once

#include "ortung/container/Export.hpp"
#include "ortung/container/Parameters.hpp"
#include "ortung/container/Pose2.hpp"
#include "ortung/container/Random.hpp"

namespace ortung {

/// How a robot's base answers to commands: the physics' side of a motion model (paper, section 4).
/// Not thread-safe.
class ORTUNG_API Drive {
 public:
  virtual ~Drive();

  /// Commands; a drive keeps to its own limits.
  virtual void setTranslationalVelocity(double metresPerSecond) = 0;
  virtual void setRotationalVelocity(double radiansPerSecond) = 0;

  /// Moves on by @p dt [s]; the change of pose in the robot's old frame.
  virtual Pose2 relocate(double dt) = 0;

  virtual double translationalVelocity() const = 0;  ///< [m/s]
  virtual double rotationalVelocity() const = 0;     ///< [rad/s]
  /// Something holds the robot: it does not move on, but may still turn.
  virtual void block() = 0;
};

/// [drive] of a robot file.
struct DriveConfig {
  double maxSpeed = 0.8;                   ///< `max_speed_m_s`
  double maxTurn = 2.0943951024;           ///< `max_turn_deg_s`, 120 degrees [rad/s]
  double acceleration = 1.0;               ///< `acceleration_m_s2`
  double turnAcceleration = 6.2831853072;  ///< `turn_acceleration_deg_s2`, 360 degrees [rad/s^2]
  double bodyHeight = 0.5;                 ///< `body_height_m`: what other robots' rays hit

  // Odometry walks away from the truth at random; variances add up over way and turn.
  double distanceSigma = 0.02;         ///< `odometry_distance_sigma_m`: after 1 m driven [m]
  double headingSigma = 0.0174532925;  ///< `odometry_heading_sigma_deg`: after 1 m driven [rad]
  double turnSigma = 0.0698131701;     ///< `odometry_turn_sigma_deg`: after a whole turn [rad]
  // Systematic error: odometry measures this times the truth.
  double distanceScale = 1.0;  ///< `odometry_distance_scale`
  double turnScale = 1.0;      ///< `odometry_turn_scale`

  /// @throws ConfigError also for keys it does not know
  ORTUNG_API static DriveConfig read(const Parameters& drive);
  /// What odometry measures of a true change of pose; @p noise may be null: the change itself.
  ORTUNG_API Pose2 measure(const Pose2& change, Random* noise) const;
};

/// Two driven wheels: velocities change by limited accelerations, the way is an arc.
class ORTUNG_API DifferentialDrive : public Drive {
 public:
  explicit DifferentialDrive(const DriveConfig& config) : config_(config) {}
  ~DifferentialDrive() override;

  void setTranslationalVelocity(double metresPerSecond) override;
  void setRotationalVelocity(double radiansPerSecond) override;
  Pose2 relocate(double dt) override;
  double translationalVelocity() const override { return speed_; }
  double rotationalVelocity() const override { return turn_; }
  void block() override { speed_ = 0.0; }

 private:
  DriveConfig config_;
  double wantedSpeed_ = 0.0;
  double wantedTurn_ = 0.0;
  double speed_ = 0.0;
  double turn_ = 0.0;
};

}  // namespace ortung
