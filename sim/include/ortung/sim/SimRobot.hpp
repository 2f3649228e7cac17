#pragma once

#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/core/Message.hpp"
#include "ortung/core/RobotCommands.hpp"
#include "ortung/core/SensorContainer.hpp"
#include "ortung/robot/RobotFile.hpp"
#include "ortung/sim/RobotShape.hpp"
#include "ortung/sim_api/Drive.hpp"
#include "ortung/sim_api/Player.hpp"
#include "ortung/sim_api/Sensor.hpp"

namespace ortung {

/// One robot of a simulation: shape, drive, sensors, and the container that they fill. A plugin
/// that throws, or returns invalid numbers, is switched off, and problems() says which one and why.
/// Not thread-safe; readers of the container hold its lock.
class ORTUNG_API SimRobot : public RobotCommands {
 public:
  /// @param random generator of this robot alone
  /// @param noise whether sensors and odometry have noise
  /// @throws ConfigError, PluginError
  SimRobot(const RobotConfig& config, PluginFactory& factory, const Pose2& start,
           const Random& random, bool noise);
  ~SimRobot() override;
  SimRobot(const SimRobot&) = delete;
  SimRobot& operator=(const SimRobot&) = delete;

  // --- commands from outside
  void setTranslationalVelocity(double metresPerSecond) override;
  void setRotationalVelocity(double radiansPerSecond) override;
  void setMotion(std::span<const double> numbers) override;
  /// Sets a manipulator; it moves in the next cycle, or as soon as there is room.
  void setManipulator(std::string_view manipulator, std::string_view state) override;

  /// Returns the commands interface of this robot's player. Unlike commands from outside it does
  /// not throw once the drive has failed; that is reported by problems().
  RobotCommands& voice() { return voice_; }
  /// Returns the number of motion commands from outside.
  std::uint64_t orders() const { return orders_; }
  /// Holds the robot in place, whatever its commands, or releases it.
  void hold(bool isHeld) { isHeld_ = isHeld; }
  bool isHeld() const { return isHeld_; }

  /// Receives the messages of its team: its features of the format TalkData get them with the next
  /// readings. @param said all new messages, in the order of time
  void hear(Timestamp now, std::span<const Heard> said);
  /// Returns whether it has such a feature.
  bool hasEars() const { return !ears_.empty(); }

  /// Indices of a manipulator and of one of its states in shape().
  struct WantedState {
    std::size_t manipulator = 0;
    std::size_t state = 0;
  };
  /// Finds a manipulator and its state by name, or the state by its number.
  /// @throws std::invalid_argument that names the robot and lists what it has
  WantedState findManipulator(std::string_view manipulator, std::string_view state) const;

  /// Returns the current state of each manipulator of shape(), as its index among the states.
  std::span<const std::size_t> manipulatorStates() const { return manipulatorStates_; }

  /// Returns the drive, which takes commands and gives limits. It refuses numbers that are not
  /// finite, and command vectors of another size, with std::invalid_argument that names the robot.
  Drive& drive() { return *drive_; }
  const Drive& drive() const { return *drive_; }

  /// Declares whether readings of the matching features are wanted: sensors on demand sense only
  /// then, or while another feature of the robot is derived from theirs.
  void setWanted(const SensorQuery& query, bool wanted);

  /// Returns the cost of its sensors [rays/s] at a given cycle [s], see Sensor::rays().
  double raysPerSecond(double cycle) const;
  /// Returns the rays of one reading of each sensor, to which their memory is about proportional.
  double raysAtOnce() const;

  const RobotConfig& config() const { return config_; }
  const RobotShape& shape() const { return shape_; }
  /// Returns the container. If the simulation senses only when readings are asked for, it generates
  /// those of this robot now, and from now on whenever they are due, since callers keep it.
  SensorContainer& container();
  const SensorContainer& container() const;
  const RobotState& state() const { return state_; }
  /// Returns the failures of its plugins, in the order of time.
  std::span<const std::string> problems() const { return problems_; }

 private:
  friend class Simulation;
  friend class LateReadings;

  /// Generates the readings that are due. If there are any, the true pose is one of them. @returns
  /// the readings of this cycle, valid until the next call
  std::span<Message> sense(const World& world, Timestamp now);
  /// Postpones the readings that are due, and with them older ones of the same sensors. @returns
  /// the readings of a cycle in which it heard something
  std::span<Message> postpone(const World& world, Timestamp now);
  bool hasPostponed(Timestamp time) const;
  /// Returns the time of the oldest readings that were postponed.
  std::optional<Timestamp> firstPostponed() const;
  /// Generates the readings that were postponed at a time, whose state it must have. @returns them,
  /// valid until the next call
  std::span<Message> sensePostponed(const World& world, Timestamp time);
  bool isRead() const { return !whenRead_; }  ///< whether anybody has asked for its container
  /// Returns the state that a manipulator should enter; nothing if it is in that state.
  std::optional<std::size_t> nextState(std::size_t manipulator, Timestamp now);
  void enterState(std::size_t manipulator, std::size_t state, Timestamp now);
  /// Returns the change of pose that the drive intends within @p dt [s].
  Pose2 plan(Timestamp now, double dt);
  /// Takes over the pose from the physics.
  /// @param velocity in the field frame
  /// @param wasDisturbed whether the motion differs from plan()
  void move(const Pose2& pose, const Twist& velocity, bool wasDisturbed);
  /// Moves the robot to another pose, unnoticed by its odometry.
  void place(const Pose2& pose);

  class Voice : public RobotCommands {
   public:
    explicit Voice(SimRobot& robot) : robot_(robot) {}
    void setTranslationalVelocity(double metresPerSecond) override;
    void setRotationalVelocity(double radiansPerSecond) override;
    void setMotion(std::span<const double> numbers) override;
    void setManipulator(std::string_view manipulator, std::string_view state) override;

   private:
    template <class Command>
    void command(const Command& command);
    SimRobot& robot_;
  };

  struct Mounted;
  void markInputs();
  bool takeDue(Mounted& mounted, Timestamp now);
  std::span<Message> frame(Timestamp now);
  void generate(Mounted& mounted, const World& world, Timestamp now);
  void extract(Timestamp now);
  void collect(Mounted& mounted, Timestamp now);
  void addGroundTruth(Timestamp now);
  Message& nextMessage();
  void report(Timestamp now, const std::string& what);
  template <class Command>
  void command(const Command& command);
  void switchDriveOff(const std::exception& why);

  RobotConfig config_;
  RobotShape shape_;
  SensorContainer container_;
  std::vector<Mounted> sensors_;
  std::vector<SensorData*> ears_;  ///< its features of the format TalkData
  bool hasHeard_ = false;          ///< whether it has received talk that no reading contains yet
  SensorData* truth_ = nullptr;    ///< its ground truth feature if no sensor provides it, or null
  std::unique_ptr<Drive> drive_;
  bool driveWorks_ = true;
  bool extracts_ = false;  ///< whether it has extractors, and none has failed
  Pose2 planned_;          ///< change of pose that the drive intended last
  Voice voice_{*this};
  std::uint64_t orders_ = 0;
  bool isHeld_ = false;
  RobotState state_;
  Random odometryRandom_;
  Random slipRandom_;
  bool noise_;
  /// Whether a sensor's random numbers depend on the time alone, not on earlier readings.
  bool noiseByTime_ = false;
  /// Called when its container is asked for, if its readings are generated only then.
  mutable std::function<void()> whenRead_;
  std::vector<Message> frame_;  ///< messages, which are reused so that a cycle allocates nothing
  std::size_t inFrame_ = 0;
  Timestamp now_ = 0;      ///< time of the current cycle
  Timestamp nextDue_ = 0;  ///< earliest time at which a sensor is due
  std::vector<std::uint32_t> truthWords_;
  std::vector<std::size_t> manipulatorStates_;
  std::vector<std::size_t> wantedStates_;
  std::vector<Timestamp> enteredAt_;
  std::vector<std::string> problems_;
  std::size_t problemsTold_ = 0;
};

}  // namespace ortung
