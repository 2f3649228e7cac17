#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Parameters.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/base/Time.hpp"
#include "ortung/core/RobotCommands.hpp"
#include "ortung/core/SensorContainer.hpp"
#include "ortung/sim_api/Abi.hpp"
#include "ortung/sim_api/Drive.hpp"
#include "ortung/sim_api/Game.hpp"
#include "ortung/sim_api/Stage.hpp"
#include "ortung/tables/FieldRegion.hpp"

namespace ortung {

/// The size of a player's robot and the commands that it takes.
struct RobotAbilities {
  struct Manipulator {
    std::string name;
    std::vector<std::string> states;  ///< names of its states; the first is the initial one
  };
  double radius = 0.0;  ///< radius of the circle around its body [m]
  double height = 0.0;  ///< height of its body [m]
  DriveLimits limits;
  std::string motionKind;  ///< Drive::kind(): what setMotion() takes, for programs
  std::string motionHelp;  ///< what the numbers of setMotion() mean, for people
  std::vector<Manipulator> manipulators;
};

/// What a robot has learned, so that its player can localize it: see ortung/mcl_player.
struct Taught {
  Parameters mcl;     ///< table [mcl] of the robot file
  Parameters motion;  ///< table [motion] of the robot file
  /// Region in which the robot can stand according to its tables; null: its features have none.
  std::shared_ptr<const FieldRegion> region;
};

/// The pose that a player believes its robot to have.
struct BelievedPose {
  Timestamp stamp = 0;  ///< time by the clock of the readings [us]
  Pose2 pose;           ///< pose in the field frame
};

/// A message that a robot sent to all of its team.
struct Heard {
  std::string from;     ///< name of the sender
  Timestamp stamp = 0;  ///< time of sending by the clock of the readings [us]
  std::string text;
};

/// A player's interface to the world: its robot's sensors and commands, its team, and the referee's
/// decisions. It is the same inside the simulator and in a client of a server, except that a client
/// has no stage. Not thread-safe.
class ORTUNG_API PlayerSeat {
 public:
  virtual ~PlayerSeat();

  /// Returns the name of its robot, which is unique on the field.
  virtual const std::string& name() const = 0;
  /// Returns the name of its team; "": none.
  virtual const std::string& team() const = 0;
  /// Returns the current time by the clock of the readings [us].
  virtual Timestamp now() const = 0;
  /// Returns the features of its robot with their newest readings.
  virtual SensorContainer& container() = 0;
  /// Returns the interface that commands its robot. A player need not catch what it throws: its
  /// supervisor does.
  virtual RobotCommands& robot() = 0;
  /// Returns its robot's size, limits and manipulators.
  virtual const RobotAbilities& abilities() const = 0;
  /// Returns what is known of the field in advance; empty if nothing is.
  virtual const FieldModel& field() const = 0;
  /// Returns what its robot has learned; empty unless its supervisor provides tables.
  virtual const Taught& taught() const;
  /// Returns the state of the game, as the referee announced it last.
  virtual const Game& game() const = 0;
  /// Returns a random generator of its own, which is seeded by the seed of the run.
  virtual Random& random() = 0;

  /// Sends a message to all others of its team, who receive it in the next cycle; a robot without a
  /// team sends it to all others without one.
  /// @param text printable ASCII, at most 400 characters @throws std::invalid_argument
  virtual void say(std::string_view text) = 0;
  /// Returns the messages received since the last call of senseAndAct(), in the order of time.
  virtual std::span<const Heard> heard() const = 0;

  /// Returns the world's true state; null on a real field, for clients, and for players that must
  /// not see it.
  virtual Stage* stage() = 0;
};

/// An option of a player's constructor, for help texts.
struct PlayerOption {
  std::string key;
  std::string unit;      ///< unit or choices, e.g. "m/s", "still|random"; "" if there is none
  std::string fallback;  ///< default value
  std::string meaning;   ///< description in one line
};

/// A robot's behaviour (paper, section 4): it reads what the robot senses and commands its motion
/// and manipulators. Its constructor takes its options.
/// The same plugin runs inside the simulator and as a client of a server. A player that throws, or
/// commands numbers that are not finite, is stopped with a message that names it, and its robot
/// leaves the field. Not thread-safe: a player is called by one thread at a time, but different
/// players may be called by different threads.
class ORTUNG_API Player {
 public:
  static constexpr const char* kInterface = "ortung.Player/" ORTUNG_SIM_API_ABI;
  virtual ~Player();

  /// Returns the robot file that it uses if none is given: an absolute path, or a name in the
  /// folder `robots` of the maps. Empty: the user must give one.
  virtual std::filesystem::path robotFile() const { return {}; }
  /// Returns the time between two calls of senseAndAct() [s]; 0: it is called in each cycle.
  virtual double period() const { return 0.0; }
  /// Returns whether it needs PlayerSeat::stage().
  virtual bool needsStage() const { return false; }
  /// Returns whether it needs its robot's tables for this world, see PlayerSeat::taught().
  virtual bool needsTables() const { return false; }
  /// Returns whether it reads sensors that sense on demand: pictures themselves, not the features
  /// extracted from them.
  virtual bool needsPictures() const { return false; }
  /// Returns the pose that it believed its robot to have when it acted last, to be shown or
  /// compared with the truth; nothing if it does not know or does not say.
  virtual std::optional<BelievedPose> believedPose() const { return std::nullopt; }
  /// Called once before it acts; its robot is on the field and has sensed nothing yet.
  virtual void begin(PlayerSeat&) {}
  /// Reads the sensors and commands the robot. @returns whether it continues; otherwise it has
  /// accomplished its task, and its robot leaves the field
  virtual bool senseAndAct(PlayerSeat& seat) = 0;
  /// Called once when the player ends, for whatever reason; its robot is still on the field.
  virtual void end(PlayerSeat&) {}
};

/// A player's description of itself: an optional plugin with the player's name, so that help can be
/// shown without making the player. Immutable.
class ORTUNG_API PlayerHelp {
 public:
  static constexpr const char* kInterface = "ortung.PlayerHelp/" ORTUNG_SIM_API_ABI;
  /// @param what one line on what the player does
  PlayerHelp(std::string what, std::vector<PlayerOption> options);
  virtual ~PlayerHelp();

  const std::string& what() const { return what_; }
  const std::vector<PlayerOption>& options() const { return options_; }

 private:
  std::string what_;
  std::vector<PlayerOption> options_;
};

}  // namespace ortung
