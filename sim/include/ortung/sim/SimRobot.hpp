#pragma once

#include <exception>
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

/// One robot of a simulation: shape, drive, sensors, and the container that they fill.
/// A plugin that throws, or gives numbers that make no sense, is switched off, and problems() tells
/// which one and why.
/// Not thread-safe; readers of the container hold its lock.
class ORTUNG_API SimRobot : public RobotCommands {
 public:
  /// @param random of this robot alone
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
  /// It moves in the cycle that begins, or as soon as it has room.
  void setManipulator(std::string_view manipulator, std::string_view state) override;

  /// The voice of the player that sits on this robot. Unlike commands from outside it says nothing
  /// once the drive has failed, which is among the problems().
  RobotCommands& voice() { return voice_; }
  /// How many times it was told from outside to move.
  std::uint64_t orders() const { return orders_; }
  /// Whether it stands where it is, whatever it is told.
  void hold(bool isHeld) { isHeld_ = isHeld; }
  bool isHeld() const { return isHeld_; }

  /// What its team has told it: its features of the format TalkData have it with the readings that
  /// are sensed next. @param said all that is new, in the order of time
  void hear(Timestamp now, std::span<const Heard> said);
  /// Whether it has such a feature.
  bool hasEars() const { return !ears_.empty(); }

  /// Places of a manipulator and of one of its states, in shape().
  struct WantedState {
    std::size_t manipulator = 0;
    std::size_t state = 0;
  };
  /// @throws std::invalid_argument that names the robot and what it has
  WantedState findManipulator(std::string_view manipulator, std::string_view state) const;

  /// The present state of each manipulator of shape(), as its place among the states.
  std::span<const std::size_t> manipulatorStates() const { return manipulatorStates_; }

  /// What drivers command and tell limits by. Numbers that are not finite, and command vectors of
  /// another size, are refused with std::invalid_argument that names the robot.
  Drive& drive() { return *drive_; }
  const Drive& drive() const { return *drive_; }

  /// Says whether somebody reads what matches: sensors that sense on demand do so only then, or
  /// while another of the robot's features is made of theirs.
  void setWanted(const SensorQuery& query, bool wanted);

  /// What its sensors cost [rays/s] in a world with cycles of a length [s], see Sensor::rays().
  double raysPerSecond(double cycle) const;
  /// The same for one reading of each sensor: about what they take of memory.
  double raysAtOnce() const;

  const RobotConfig& config() const { return config_; }
  const RobotShape& shape() const { return shape_; }
  SensorContainer& container() { return container_; }
  const SensorContainer& container() const { return container_; }
  const RobotState& state() const { return state_; }
  /// What went wrong with its plugins, in the order of time.
  std::span<const std::string> problems() const { return problems_; }

 private:
  friend class Simulation;

  /// Generates the readings that are due. If there are any, the true pose is one of them.
  /// @returns the readings of this moment, valid until the next call
  std::span<Message> sense(const World& world, Timestamp now);
  /// The state that a manipulator is to enter, if that is not the one it is in.
  std::optional<std::size_t> nextState(std::size_t manipulator, Timestamp now);
  void enterState(std::size_t manipulator, std::size_t state, Timestamp now);
  /// The change of pose that the drive wants within @p dt [s].
  Pose2 plan(Timestamp now, double dt);
  /// Goes where the physics brought it.
  /// @param velocity in the field frame
  /// @param wasDisturbed whether that is not what plan() said
  void move(const Pose2& pose, const Twist& velocity, bool wasDisturbed);
  /// Carries the robot elsewhere, unnoticed by its odometry.
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
  std::vector<SensorData*> ears_;  ///< TalkData
  bool hasHeard_ = false;          ///< what no message tells of yet
  SensorData* truth_ = nullptr;    ///< ground truth that no sensor gives, or null
  std::unique_ptr<Drive> drive_;
  bool driveWorks_ = true;
  bool extracts_ = false;  ///< whether it has extractors, and none has failed
  Pose2 planned_;          ///< change of pose that the drive wanted last
  Voice voice_{*this};
  std::uint64_t orders_ = 0;
  bool isHeld_ = false;
  RobotState state_;
  Random odometryRandom_;
  Random slipRandom_;
  bool noise_;
  std::vector<Message> frame_;  ///< messages are used again, so that none is allocated in a cycle
  std::size_t inFrame_ = 0;
  Timestamp now_ = 0;      ///< of the cycle
  Timestamp nextDue_ = 0;  ///< no sensor is due before
  std::vector<std::uint32_t> truthWords_;
  std::vector<std::size_t> manipulatorStates_;
  std::vector<std::size_t> wantedStates_;
  std::vector<Timestamp> enteredAt_;
  std::vector<std::string> problems_;
  std::size_t problemsTold_ = 0;
};

}  // namespace ortung
