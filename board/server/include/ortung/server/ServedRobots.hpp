#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/base/Time.hpp"
#include "ortung/core/Message.hpp"
#include "ortung/core/RobotCommands.hpp"
#include "ortung/robot/RobotFile.hpp"
#include "ortung/server/ServedFeature.hpp"

namespace ortung {

/// What a client wants on the field.
struct RobotWish {
  std::string name;
  RobotConfig config;
  std::optional<Pose2> start;  ///< pose in the field frame; nothing: where there is room
  std::string team = {};       ///< the robot's team; "": none
  bool wanders = false;        ///< the server drives it about until the first command
};

/// A robot that takes part.
struct ServedRobot {
  std::vector<ServedFeature> features;  ///< features in the order of readings()
  double raysPerSecond = 0.0;           ///< rays that its sensors cost [1/s], see Sensor::rays()
  double raysAtOnce = 0.0;  ///< rays for one reading of each sensor, about what they take of memory
};

/// A robot that was there before any client: it belongs to the world.
struct Resident {
  RobotId robot;
  std::string name;
  std::vector<ServedFeature> features;
};

/// What one robot said to all others of its team.
struct ServedTalk {
  Timestamp stamp = 0;  ///< time of the words on the clock of the readings [us]
  std::string from;     ///< the robot's name
  std::string text;     ///< printable ASCII
};

/// The robots of a served world: which there are, their readings, commands, and talk. A
/// part of ServedWorld, as which it is called.
class ORTUNG_API ServedRobots {
 public:
  virtual ~ServedRobots();

  /// Robots of the world's own, numbered from 1. They may come and go: one that comes has a number
  /// that no robot had before.
  virtual std::vector<Resident> residents() const = 0;
  /// Changes whenever residents() do.
  virtual std::uint64_t residentsVersion() const = 0;
  /// Puts a client's robot on the field, from the next cycle on.
  /// @param robot its number, which no robot had before
  /// @throws ServeError, or the errors of configurations and plugins, if it can't take part
  virtual ServedRobot addRobot(RobotId robot, RobotWish wish) = 0;
  /// Takes a client's robot from the field.
  virtual void removeRobot(RobotId robot) = 0;
  /// A robot's parameters and commands, one line each, its first word saying which: "drive
  /// COMMAND", "motion kind=K numbers=N", "limits v_m_s=V w_rad_s=W ...", "body radius_m=R ...",
  /// "manipulator NAME STATE ...".
  virtual std::vector<std::string> abilities(RobotId robot) const = 0;
  /// A robot's team and player, " key=value ..." for its line of LIST robots; "" if it has none.
  virtual std::string side(RobotId robot) const = 0;
  /// Moves a robot, a client's or the world's own, to a pose in the field frame.
  /// @throws ServeError where robots can't be placed, or not there
  virtual void placeRobot(RobotId robot, const Pose2& pose) = 0;

  /// Sets the features that clients ask for at present, whenever these change, so that costly ones
  /// need not be sensed without need. None at first.
  virtual void want(RobotId robot, std::span<const SensorId> features) = 0;
  /// What the robot's sensors gave in the last cycle; valid until the next call of anything.
  /// Called once a cycle, by who may take words away.
  virtual std::span<Message> readings(RobotId robot) = 0;
  /// Returns readings that have come since the call of readings() though no cycle has passed: those
  /// of features that other threads compute. Called several times a second while the world is
  /// paused.
  virtual std::vector<Message> lateReadings(RobotId robot) = 0;

  /// Returns the commands of a robot; valid until the next call of anything.
  virtual RobotCommands& commands(RobotId robot) = 0;
  /// Sends a robot's text to all others of its team; without effect where there is no talk.
  virtual void tell(RobotId robot, std::string_view text) = 0;
  /// Returns the texts sent to a robot since the last call, in the order of time.
  virtual std::vector<ServedTalk> takeHeard(RobotId robot) = 0;
};

}  // namespace ortung
