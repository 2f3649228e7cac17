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

/// The robots of a served world: who there is, what they sense, are told and tell each other. A
/// part of ServedWorld, as which it is called.
class ORTUNG_API ServedRobots {
 public:
  virtual ~ServedRobots();

  /// Robots of the world's own, numbered from 1. They may come and go: one that comes has a number
  /// that no robot had before.
  virtual std::vector<Resident> residents() const = 0;
  /// Changes whenever residents() do.
  virtual std::uint64_t residentsVersion() const = 0;
  virtual ServedRobot addRobot(RobotId robot, RobotWish wish) = 0;
  virtual void removeRobot(RobotId robot) = 0;
  /// What a robot is and can be told, one line each, its first word saying which: "drive COMMAND",
  /// "motion kind=K numbers=N",
  /// "limits v_m_s=V w_rad_s=W ...", "body radius_m=R ...", "manipulator NAME STATE ...".
  virtual std::vector<std::string> abilities(RobotId robot) const = 0;
  /// Whose a robot is, " key=value ..." to be added to its line of LIST robots; "" if nobody's.
  virtual std::string side(RobotId robot) const = 0;
  virtual void placeRobot(RobotId robot, const Pose2& pose) = 0;

  /// Which features clients ask for at present, whenever that changes: what costs much to sense
  /// need not be sensed for nobody. None at first.
  virtual void want(RobotId robot, std::span<const SensorId> features) = 0;
  /// What the robot's sensors gave in the last cycle; valid until the next call of anything.
  /// Called once a cycle, by who may take words away.
  virtual std::span<Message> readings(RobotId robot) = 0;
  /// What has come of a robot since readings() was asked, though no cycle has passed since: of
  /// features that somebody else works out. Asked several times a second while the world stands.
  virtual std::vector<Message> lateReadings(RobotId robot) = 0;

  /// Through which a robot is commanded; valid until the next call of anything.
  virtual RobotCommands& commands(RobotId robot) = 0;
  /// What a robot says to all others of its team; nobody hears it where there is no talk.
  virtual void tell(RobotId robot, std::string_view text) = 0;
  /// What a robot was told since it was last asked, in the order of time.
  virtual std::vector<ServedTalk> takeHeard(RobotId robot) = 0;
};

}  // namespace ortung
