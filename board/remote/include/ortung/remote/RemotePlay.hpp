#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "ortung/base/Export.hpp"
#include "ortung/client/RobotSession.hpp"
#include "ortung/sim_api/Player.hpp"

namespace ortung {

/// A player did something wrong and was stopped; the message names it.
class ORTUNG_API PlayerStopped : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
  ~PlayerStopped() override;
};

/// Which player runs on which server, and how much it may take.
struct RemotePlayConfig {
  SessionOptions session;  ///< its name is that of the robot
  std::string plugin;      ///< name of the player, for messages
  std::string team;        ///< the robot's team; "": none
  /// Robot file; empty: the player's own.
  std::filesystem::path robot;
  /// What is known of the field and what the robot's features expect; empty: nothing.
  std::filesystem::path tables;
  std::uint64_t seed = 1;   ///< seed of the player's random numbers
  bool isLockstep = false;  ///< the world goes on only as far as the player has acted
  double budget = 1.0;      ///< processor time that one call may take [s]; 0: any
  /// Time after which the player ends [s]; nothing: when the player itself ends.
  std::optional<double> duration;
  std::function<bool()> goesOn = {};  ///< asked before each cycle; empty: it does
};

/// A player on a robot of a message board's world (paper, section 4): the same that sits in the
/// simulator, but that there is no stage. Not thread-safe.
class ORTUNG_API RemotePlay {
 public:
  /// Brings its robot onto the field.
  /// @throws std::invalid_argument for a player that needs a stage or names no robot file;
  ///   ConfigError, PluginError for the robot file; ConnectionLost, ServerRefused
  RemotePlay(std::unique_ptr<Player> player, const RemotePlayConfig& config);
  /// The robot leaves the field.
  ~RemotePlay();
  RemotePlay(const RemotePlay&) = delete;
  RemotePlay& operator=(const RemotePlay&) = delete;

  /// Plays until the player, the world or the time ends, or it is not to go on.
  /// @throws PlayerStopped, ConnectionLost, ServerRefused
  void run();
  /// By the clock of the readings.
  Timestamp now() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace ortung
