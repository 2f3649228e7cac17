#pragma once

#include <exception>
#include <string>
#include <string_view>
#include <vector>

#include "ortung/client/RemoteRobot.hpp"
#include "ortung/sim_api/Player.hpp"

namespace ortung::remote {

/// Commands of a player to its robot. Numbers that are none never leave; what goes wrong with the
/// connection is not the player's fault, and kept for who runs it.
class Voice : public RobotCommands {
 public:
  explicit Voice(RemoteRobot& robot) : robot_(robot) {}

  void setTranslationalVelocity(double metresPerSecond) override;
  void setRotationalVelocity(double radiansPerSecond) override;
  void setMotion(std::span<const double> command) override;
  void setManipulator(std::string_view manipulator, std::string_view state) override;
  void say(std::string_view text);
  /// @throws what the connection threw when the player talked through it last
  void rethrow() const;

 private:
  template <class Command>
  void tell(const Command& command);

  RemoteRobot& robot_;
  std::exception_ptr lost_;
};

/// A player's seat on a robot of a server's field.
class RemoteSeat : public PlayerSeat {
 public:
  /// @param robot borrowed
  RemoteSeat(RemoteRobot& robot, std::string name, std::string team, FieldModel field,
             Taught taught, const Random& random);

  const std::string& name() const override { return name_; }
  const std::string& team() const override { return team_; }
  Timestamp now() const override { return now_; }
  SensorContainer& container() override { return robot_.container(); }
  RobotCommands& robot() override { return voice_; }
  const RobotAbilities& abilities() const override { return abilities_; }
  const FieldModel& field() const override { return field_; }
  const Taught& taught() const override { return taught_; }
  const Game& game() const override { return game_; }
  Random& random() override { return random_; }
  void say(std::string_view text) override;
  std::span<const Heard> heard() const override { return heard_; }
  Stage* stage() override { return nullptr; }

  // --- for whoever runs the player
  /// The server's clock.
  void look();
  /// What was said meanwhile. @throws ConnectionLost, ServerRefused
  void listen();
  /// How the game stands; free where the server knows none. @throws as listen()
  void watchGame();
  void forgetHeard() { heard_.clear(); }
  const Voice& voice() const { return voice_; }

 private:
  RemoteRobot& robot_;
  Voice voice_;
  std::string name_;
  std::string team_;
  FieldModel field_;
  Taught taught_;
  Random random_;
  RobotAbilities abilities_;
  Game game_;
  bool hasGame_ = true;  ///< the server knows the game
  Timestamp now_ = 0;
  std::vector<Heard> heard_;
};

}  // namespace ortung::remote
