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

/// What a sensor may know of the robot that carries it.
struct RobotState {
  Pose2 pose;                          ///< true, in the field frame
  Twist velocity;                      ///< true, in the field frame
  Pose2 odometry;                      ///< what the motion side believes, in the odometry frame
  double translationalVelocity = 0.0;  ///< [m/s], as odometry measures it
  double rotationalVelocity = 0.0;     ///< [rad/s], as odometry measures it
  std::span<const std::uint32_t> motionData;  ///< of the drive's inner state, for odometry
  RobotNumber number = 0;                     ///< rays ignore this robot's body
  double lateralVelocity = 0.0;               ///< to the left [m/s], as odometry measures it
};

/// The simulation half of a sensor plugin: generates data from the world (paper, section 4).
/// Its constructor takes the same Parameters as the data half; a parameter nobody reads is an
/// error, so both halves read all settings of the plugin through one common function.
/// Not thread-safe: calls come one at a time.
class ORTUNG_API Sensor {
 public:
  static constexpr const char* kInterface = "ortung.Sensor/" ORTUNG_SIM_API_ABI;
  virtual ~Sensor();

  /// Writes what the sensor sees into some or all features of its device.
  /// @param noise nullptr: without noise, as learning needs it
  /// @param data features made by the data half of the same plugin from the same parameters
  virtual void generateData(const World& world, const RobotState& robot, Random* noise,
                            Timestamp now, std::span<SensorData* const> data) = 0;

  /// Time between two readings [s]; 0: every cycle.
  virtual double period() const { return 0.0; }

  /// Whether it senses only while somebody wants its readings, since they cost much: a camera whose
  /// pictures are drawn.
  virtual bool isOnDemand() const { return false; }

  /// About how many rays a reading takes, or computation as long as theirs: a server refuses robots
  /// whose sensors would hold up all others.
  virtual double rays() const { return 1.0; }
};

}  // namespace ortung
