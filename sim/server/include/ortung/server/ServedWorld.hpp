#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/base/Time.hpp"
#include "ortung/core/Message.hpp"
#include "ortung/core/RobotCommands.hpp"
#include "ortung/core/SensorContainer.hpp"
#include "ortung/robot/RobotFile.hpp"

namespace ortung {

/// Number by which clients name a robot; never used again within one server.
using RobotId = std::uint32_t;

/// A request that can't be granted: becomes "ERR code text" on the wire.
class ORTUNG_API ServeError : public std::runtime_error {
 public:
  ServeError(std::string code, const std::string& text)
      : std::runtime_error(text), code_(std::move(code)) {}
  ~ServeError() override;
  const std::string& code() const { return code_; }

 private:
  std::string code_;
};

/// What a client wants on the field.
struct RobotWish {
  std::string name;
  RobotConfig config;
  std::optional<Pose2> start;  ///< in the field frame; nothing: where there is room
  std::string team = {};       ///< "": none
  bool wanders = false;        ///< the server drives it about until the first command
};

/// One feature of a robot that takes part.
struct ServedFeature {
  SensorId id;
  std::string wordsHelp;    ///< one line on what the words mean, for people
  Pose2 mount = {};         ///< of its sensor, in the robot frame
  std::string format = {};  ///< Format::toText(); "": it is not known
};

/// A robot that takes part.
struct ServedRobot {
  std::vector<ServedFeature> features;  ///< in the order of its readings
  double raysPerSecond = 0.0;           ///< what its sensors cost, see Sensor::rays()
  double raysAtOnce = 0.0;              ///< of one reading of each: about what they take of memory
};

/// A robot that was there before any client: it belongs to the world.
struct Resident {
  RobotId robot;
  std::string name;
  std::vector<ServedFeature> features;
};

/// The rectangle that nothing leaves, in the field frame [m].
struct FieldBounds {
  double xMin = 0.0;
  double yMin = 0.0;
  double xMax = 0.0;
  double yMax = 0.0;
};

/// Something movable that is no robot.
struct ServedObject {
  std::string name;  ///< by which placeObject() knows it: one printable word, its own
  std::string kind;  ///< "ball", ...
  std::string colour = {};
  double radius = 0.0;  ///< of the circle that holds it [m]
  double height = 0.0;  ///< [m]
};

struct WorldDescription {
  std::string name;
  std::string fingerprint;                 ///< "" if it is not known
  std::string kind;                        ///< "simulation", "record" or "robot"
  std::optional<FieldBounds> bounds = {};  ///< nothing: they are not known
  std::vector<ServedObject> objects = {};
  std::optional<Timestamp> length = {};  ///< of a time line that clients may seek on [us]
};

/// What one robot said to all others of its team.
struct ServedTalk {
  Timestamp stamp = 0;  ///< when it said so, by the clock of the readings
  std::string from;     ///< the robot's name
  std::string text;     ///< printable ASCII
};

/// What the message board serves: a simulation, a record as if it were one, a running robot.
/// Not thread-safe: one thread owns it. Refusals are ServeErrors, or the errors of configurations
/// and plugins.
class ORTUNG_API ServedWorld {
 public:
  virtual ~ServedWorld();

  virtual WorldDescription describe() const = 0;
  /// Names of the plugins that clients may use in the configurations of robots.
  virtual std::vector<std::string> plugins() const = 0;
  /// Players that may be started here, a line each, and behind it one for each of their options
  /// (docs/protocol.md).
  virtual std::vector<std::string> players() const { return {}; }
  /// Robots that players may be given by name, a line "robot NAME TEXT" each.
  virtual std::vector<std::string> robotKinds() const { return {}; }
  /// Stamp of the readings that the next step gives; if it is live, the time of its clock.
  virtual Timestamp now() const = 0;
  /// How long the board waits between two steps of a world whose time goes on whatever the board
  /// does [us]: a live one, such as a running robot. It can't be paused, made faster, reset, or
  /// joined by robots of clients. 0: its time is the board's.
  virtual Timestamp livePeriod() const { return 0; }
  /// Whether it may begin.
  virtual bool isReady() const { return true; }
  /// Whether there is nothing left to step to.
  virtual bool isAtEnd() const { return false; }
  /// One cycle. @throws std::runtime_error if the world can't go on
  virtual void step() = 0;

  /// What stands and is painted on the field, one line each: a kind and keys (docs/protocol.md).
  virtual std::vector<std::string> field() const { return {}; }
  /// What the world says of itself to who looks on, in the order of its readings: clients know it
  /// as robot 0. None: nothing.
  virtual std::vector<ServedFeature> truthFeatures() const { return {}; }
  /// How it is now; valid until the next call of anything.
  virtual std::span<Message> truth() { return {}; }

  /// Robots of the world's own, numbered from 1. They may come and go: one that comes has a number
  /// that no robot had before.
  virtual std::vector<Resident> residents() const { return {}; }
  /// Changes whenever residents() do.
  virtual std::uint64_t residentsVersion() const { return 0; }
  virtual ServedRobot addRobot(RobotId robot, RobotWish wish) = 0;
  /// What a robot is and can be told, one line each, its first word saying which: "drive COMMAND",
  /// "motion kind=K numbers=N", "limits v_m_s=V w_rad_s=W ...", "body radius_m=R ...", "manipulator
  /// NAME STATE ...".
  virtual std::vector<std::string> abilities(RobotId robot) const = 0;
  virtual void removeRobot(RobotId robot) = 0;
  /// Whose a robot is, " key=value ..." to be added to its line of LIST robots; "" if nobody's.
  virtual std::string side(RobotId /*robot*/) const { return {}; }
  /// Which features clients ask for at present, whenever that changes: what costs much to sense
  /// need not be sensed for nobody. None at first.
  virtual void want(RobotId, std::span<const SensorId> /*features*/) {}
  /// What the robot's sensors gave in the last cycle; valid until the next call of anything.
  /// Called once a cycle, by who may take words away.
  virtual std::span<Message> readings(RobotId robot) = 0;

  /// What has come of a robot since readings() was asked, though no cycle has passed since: of
  /// features that somebody else works out. Asked several times a second while the world stands.
  virtual std::vector<Message> lateReadings(RobotId) { return {}; }

  /// Through which a robot is commanded; valid until the next call of anything.
  virtual RobotCommands& commands(RobotId robot) = 0;

  /// What a robot says to all others of its team; nobody hears it where there is no talk.
  virtual void tell(RobotId, std::string_view /*text*/) {}
  /// What a robot was told since it was last asked, in the order of time.
  virtual std::vector<ServedTalk> takeHeard(RobotId) { return {}; }

  /// Goes to a time of its time line [us]; readings() are then what was newest there. What lies
  /// before or behind becomes its beginning or end.
  virtual void seek(Timestamp stamp);
  /// Of its chance; nothing: there is none.
  virtual std::optional<std::uint64_t> seed() const { return std::nullopt; }
  /// Starts over: time, chance and robots as at their beginning.
  virtual void reset(std::optional<std::uint64_t> seed) = 0;
  virtual void placeRobot(RobotId robot, const Pose2& pose) = 0;
  /// @param object a name of describe()
  virtual void placeObject(const std::string& object, const Pose2& pose) = 0;
};

/// As in readings of robot 0: [1/100 degree], in [0, 36000).
ORTUNG_API std::uint32_t headingWord(double radians);

/// A robot's words of `world/truth/robots` of robot 0: number, x, y, heading, and the states of its
/// manipulators, four bits each.
ORTUNG_API std::array<std::uint32_t, 5> robotWords(RobotId robot, const Pose2& poseInField,
                                                   std::uint32_t states);

/// The features of a container.
ORTUNG_API std::vector<ServedFeature> servedFeatures(const SensorContainer& container);

}  // namespace ortung
