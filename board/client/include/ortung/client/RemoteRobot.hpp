#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Time.hpp"
#include "ortung/client/RobotSession.hpp"
#include "ortung/core/SensorContainer.hpp"

namespace ortung {

/// How a RemoteRobot connects, updates its container, and reports what goes wrong.
struct RemoteOptions {
  /// Server, names and timeouts of each connection.
  SessionOptions session;
  double cycle = 0.1;      ///< period of the container's updates [s]; 0: only update() does them;
                           ///< less than 0 or NaN is refused
  bool reconnects = true;  ///< whether it connects again after the connection was lost
  /// Stamps are those of our own clock (`clock`), as if the sensors were here; otherwise the
  /// server's, which is what lockstep needs.
  bool hasLocalStamps = true;
  /// Our clock [us]; empty: that of the computer, which never goes back. It must not use the robot.
  std::function<Timestamp()> clock;
  /// Is called with what goes wrong, and when it is well again; from any thread, but by one at a
  /// time, and with no lock held: it may command the robot, whose errors it then gets as exceptions
  /// only. What it throws is ignored. What happens while it is busy waits for it, the newest 100
  /// at most. It must not destroy the robot. May be empty.
  std::function<void(const std::string&)> onTrouble;
};

/// A robot on a server's field: a container that fills itself, and commands (paper, section 3).
/// Thread-safe; readers of the container hold its lock.
class ORTUNG_API RemoteRobot : public RobotCommands {
 public:
  /// Connects, sends the robot file, and starts to update the container.
  /// @throws ConfigError, PluginError for the robot file; std::invalid_argument for options that
  ///   make no sense; ConnectionLost, ServerRefused
  RemoteRobot(const std::filesystem::path& robotFile, const RemoteOptions& options);
  /// Does not wait for the server, whatever that does.
  ~RemoteRobot() override;
  RemoteRobot(const RemoteRobot&) = delete;
  RemoteRobot& operator=(const RemoteRobot&) = delete;

  /// The container of the robot's features, which lives as long as the robot does.
  SensorContainer& container();
  /// What the server says of the robot, e.g. its greatest velocities; as of the last connection.
  RobotDescription description() const;

  // --- commands, whose errors are those of RobotSession; trouble() has them, too. While there is
  // no connection they throw ConnectionLost; a robot that comes back has to be commanded again
  void setTranslationalVelocity(double metresPerSecond) override;
  void setRotationalVelocity(double radiansPerSecond) override;
  void setMotion(std::span<const double> command) override;
  void setManipulator(std::string_view manipulator, std::string_view state) override;

  /// Sends a text to all other robots of the team. Errors are those of commands.
  void tellTeam(const std::string& text);
  /// Returns texts that other robots of the team sent since the last call, oldest first. Errors are
  /// those of commands.
  std::vector<TeamWords> hearTeam();
  /// Returns the state of the game, see RobotSession::game(). Errors are those of commands.
  std::string game();

  // --- what follows returns whether it was done; if not, trouble() says why
  /// Says a text to all other clients of the server.
  bool say(const std::string& text);
  /// Brings the container up to date now.
  bool update();
  /// Lets the server's world go on for so many cycles, and brings the container up to date: for
  /// runs that can be repeated (the server's --lockstep). The first call begins it.
  bool next(std::uint64_t cycles = 1);

  /// Waits until the container was updated again. Whether it was; trouble() does not say why not.
  /// @param timeout [s]; 0 or less: does not wait; up to infinity, of which 30 years are waited
  /// @throws std::invalid_argument if @p timeout is NaN
  bool waitForUpdate(double timeout);
  /// Whether there is a connection now; a lost one comes back if RemoteOptions::reconnects is set.
  bool isConnected() const;
  /// What went wrong last, or "".
  std::string trouble() const;
  /// What the server and other clients said since the last call.
  std::vector<std::string> takeNews();
  /// By the server's clock: the cycle that next() gave; without lockstep the stamp of the newest
  /// reading that came, of features that the container does not have, too; at first the time when
  /// it connected.
  Timestamp newest() const;
  /// How the server's clock relates to ours.
  ClockOffset clockOffset() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace ortung
