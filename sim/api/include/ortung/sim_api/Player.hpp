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

/// What a player's robot is and can be told.
struct RobotAbilities {
  struct Manipulator {
    std::string name;
    std::vector<std::string> states;  ///< it begins in the first
  };
  double radius = 0.0;  ///< of the circle around its body [m]
  double height = 0.0;  ///< [m]
  DriveLimits limits;
  std::string motionKind;  ///< Drive::kind(): what setMotion() takes, for programs
  std::string motionHelp;  ///< what the numbers of setMotion() mean, for people
  std::vector<Manipulator> manipulators;
};

/// What a robot was taught, so that its player can tell where it is: ortung/mcl_player.
struct Taught {
  Parameters mcl;     ///< [mcl] of its file
  Parameters motion;  ///< [motion]
  /// Where it can stand, by its tables; null: its features have none.
  std::shared_ptr<const FieldRegion> region;
};

/// In the field frame.
struct BelievedPose {
  Timestamp stamp = 0;  ///< by the clock of the readings
  Pose2 pose;
};

/// What somebody has said to all of his team.
struct Heard {
  std::string from;     ///< name of the robot
  Timestamp stamp = 0;  ///< when he said it, by the clock of the readings
  std::string text;
};

/// Where a player sits: its robot's sensors and commands, its team, and what the referee says. It
/// is the same inside the simulator and as a client of a server, but that there is no stage.
/// Not thread-safe.
class ORTUNG_API PlayerSeat {
 public:
  virtual ~PlayerSeat();

  /// Of its robot; no other on the field has it.
  virtual const std::string& name() const = 0;
  virtual const std::string& team() const = 0;  ///< "": none
  /// By the clock of the readings.
  virtual Timestamp now() const = 0;
  /// What its robot senses.
  virtual SensorContainer& container() = 0;
  /// The one voice that commands its robot; what it throws may be left to whoever runs the player.
  virtual RobotCommands& robot() = 0;
  virtual const RobotAbilities& abilities() const = 0;
  /// What is known of the field beforehand; empty if nothing is.
  virtual const FieldModel& field() const = 0;
  /// Nothing, if whoever runs the player has not taught its robot.
  virtual const Taught& taught() const;
  virtual const Game& game() const = 0;
  /// Chance of its own, by the seed of the run.
  virtual Random& random() = 0;

  /// To all others of its team, who hear it in the next cycle. Without a team: to all who have
  /// none.
  /// @param text printable ASCII, at most 400 characters @throws std::invalid_argument
  virtual void say(std::string_view text) = 0;
  /// What was said since it was last asked to act, in the order of time.
  virtual std::span<const Heard> heard() const = 0;

  /// The world's true state, or null: on a real field, for clients, and for players that are not to
  /// see it.
  virtual Stage* stage() = 0;
};

/// One option of a player, as its constructor reads it.
struct PlayerOption {
  std::string key;
  std::string unit;      ///< "m/s", "still|random"; "" if there is none
  std::string fallback;  ///< what holds without the option
  std::string meaning;
};

/// A robot's behaviour (paper, section 4): it reads what the robot senses and commands its motion
/// and manipulators. Its constructor takes its options.
///
/// The same plugin runs inside the simulator and as a client of a server. A player that throws, or
/// commands numbers that are none, is stopped, and the message names it; its robot leaves the
/// field. Not thread-safe: one player is called by one thread at a time, other ones by others.
class ORTUNG_API Player {
 public:
  static constexpr const char* kInterface = "ortung.Player/" ORTUNG_SIM_API_ABI;
  virtual ~Player();

  /// The robot file that it plays with where none is given: absolute, or a name in the folder
  /// `robots` of the maps. Empty: whoever starts it says which.
  virtual std::filesystem::path robotFile() const { return {}; }
  /// Between two calls of senseAndAct() [s]; 0: once in each cycle.
  virtual double period() const { return 0.0; }
  /// Whether it does nothing without PlayerSeat::stage().
  virtual bool needsStage() const { return false; }
  /// Whether it does nothing without tables of its robot for this world, see PlayerSeat::taught().
  virtual bool needsTables() const { return false; }
  /// Whether it looks at readings of sensors that sense on demand: pictures themselves, not what is
  /// found in them.
  virtual bool needsPictures() const { return false; }
  /// Where it believed its robot to be when it acted last; nothing if it does not know or does not
  /// say. For whoever shows that or compares it with the truth.
  virtual std::optional<BelievedPose> believedPose() const { return std::nullopt; }
  /// It has taken its seat; its robot stands on the field and has sensed nothing yet.
  virtual void begin(PlayerSeat&) {}
  /// Retrieves what the sensors say, and commands. @returns whether it goes on; else it has
  /// accomplished its task, and its robot leaves the field
  virtual bool senseAndAct(PlayerSeat& seat) = 0;
  /// It is over, whoever ended it; its robot is still there.
  virtual void end(PlayerSeat&) {}
};

/// What a player says of itself, without playing: a plugin beside it, under the same name, which a
/// player may have or not. Immutable.
class ORTUNG_API PlayerHelp {
 public:
  static constexpr const char* kInterface = "ortung.PlayerHelp/" ORTUNG_SIM_API_ABI;
  /// @param what it does, one line
  PlayerHelp(std::string what, std::vector<PlayerOption> options);
  virtual ~PlayerHelp();

  const std::string& what() const { return what_; }
  const std::vector<PlayerOption>& options() const { return options_; }

 private:
  std::string what_;
  std::vector<PlayerOption> options_;
};

}  // namespace ortung
