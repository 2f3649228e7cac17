#pragma once

#include <span>

#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/base/Time.hpp"
#include "ortung/core/SensorData.hpp"
#include "ortung/sim_api/Abi.hpp"
#include "ortung/sim_api/World.hpp"

namespace ortung {

/// The state of the robot that carries a sensor, as far as the sensor may know it.
struct RobotState {
  Pose2 pose;                                 ///< true pose in the field frame
  Twist velocity;                             ///< true velocity in the field frame
  Pose2 odometry;                             ///< pose by odometry, in the odometry frame
  double translationalVelocity = 0.0;         ///< forward speed as odometry measures it [m/s]
  double rotationalVelocity = 0.0;            ///< turn rate as odometry measures it [rad/s]
  std::span<const std::uint32_t> motionData;  ///< the drive's inner state, see Drive::motionData()
  RobotNumber number = 0;                     ///< the robot's number: rays ignore its body
  double lateralVelocity = 0.0;               ///< speed to the left as odometry measures it [m/s]
};

/// The simulation half of a sensor plugin: generates data from the world (paper, section 4). Its
/// constructor takes the same Parameters as the data half; an unread parameter is an error, so both
/// halves read all settings of the plugin through one common function. Not thread-safe: calls come
/// one at a time.
class ORTUNG_API Sensor {
 public:
  static constexpr const char* kInterface = "ortung.Sensor/" ORTUNG_SIM_API_ABI;
  virtual ~Sensor();

  /// Senses the world and writes the readings into some or all features of the sensor's device.
  /// @param noise random numbers of the measurement errors; nullptr: no noise, as learning needs it
  /// @param now time of the readings [us]
  /// @param data features that the data half of the same plugin made from the same parameters
  virtual void generateData(const World& world, const RobotState& robot, Random* noise,
                            Timestamp now, std::span<SensorData* const> data) = 0;

  /// Returns the time between two readings [s]; 0: it senses in every cycle.
  virtual double period() const { return 0.0; }

  /// Returns whether it senses only while its readings are wanted, because they are expensive: e.g.
  /// a camera whose pictures are rendered.
  virtual bool isOnDemand() const { return false; }

  /// Returns the approximate cost of a reading in rays. A server refuses robots whose sensors would
  /// slow down all others.
  virtual double rays() const { return 1.0; }
};

}  // namespace ortung
