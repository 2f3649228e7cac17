#pragma once

#include <memory>
#include <span>
#include <vector>

#include "ortung/config/RobotFile.hpp"
#include "ortung/container/Export.hpp"
#include "ortung/container/Message.hpp"
#include "ortung/container/Random.hpp"
#include "ortung/container/SensorContainer.hpp"
#include "ortung/sim/Driver.hpp"
#include "ortung/sim_api/Drive.hpp"
#include "ortung/sim_api/Sensor.hpp"

namespace ortung {

/// One robot of a simulation: body, drive, sensors, and the container that they fill.
/// Not thread-safe; readers of the container hold its lock.
class ORTUNG_API SimRobot {
 public:
  /// @param random of this robot alone
  /// @param noise whether sensors and odometry have noise
  /// @throws ConfigError, PluginError
  SimRobot(const RobotConfig& config, PluginFactory& factory, const Pose2& start,
           const Random& random, bool noise);
  ~SimRobot();
  SimRobot(const SimRobot&) = delete;
  SimRobot& operator=(const SimRobot&) = delete;

  /// Who commands the drive from now on; null: nobody.
  void setDriver(std::unique_ptr<Driver> driver) { driver_ = std::move(driver); }

  /// Generates the readings that are due. If there are any, the true pose is one of them.
  /// @returns the readings of this moment, valid until the next call
  std::span<const Message> sense(const World& world, Timestamp now);

  /// Lets the driver command; the pose where the robot would be @p dt [s] later.
  Pose2 plan(Timestamp now, double dt);
  /// Goes where plan() said.
  void move();
  /// Stays where it is, since something is in the way.
  void block();
  /// Carries the robot elsewhere, unnoticed by its odometry.
  void place(const Pose2& pose) { state_.pose = pose; }

  /// By which rays know its body.
  void setNumber(RobotNumber number) { state_.number = number; }
  const RobotConfig& config() const { return config_; }
  double bodyHeight() const { return bodyHeight_; }  ///< [m]
  SensorContainer& container() { return container_; }
  Drive& drive() { return *drive_; }
  const RobotState& state() const { return state_; }

 private:
  struct Mounted;
  void generate(Mounted& mounted, const World& world, Timestamp now);
  void addGroundTruth(Timestamp now);

  RobotConfig config_;
  double bodyHeight_ = 0.5;  ///< `body_height_m` of [drive]: what other robots' rays hit [m]
  SensorContainer container_;
  std::vector<Mounted> sensors_;
  SensorData* truth_ = nullptr;  ///< ground truth that no sensor gives, or null
  std::unique_ptr<Drive> drive_;
  std::unique_ptr<Driver> driver_;
  RobotState state_;
  Pose2 change_;  ///< of pose, as planned, in the robot's frame
  Random odometryRandom_;
  Random slipRandom_;
  bool noise_;
  std::vector<Message> frame_;
};

}  // namespace ortung
