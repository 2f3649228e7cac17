#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "ortung/sim/SimRobot.hpp"
#include "ortung/sim_api/Player.hpp"

namespace ortung {

/// Adds a message to a listener's queue; if there are too many, the oldest are lost.
void keepHeard(std::vector<Heard>& waiting, const Heard& message);

/// A player's seat on a simulated robot.
class SimSeat : public PlayerSeat {
 public:
  /// @param robot, field borrowed
  /// @param stage the stage, or null if the player must not see it
  /// @param region region in which its robot can stand; null: it has no tables
  /// @param say sends a message to the team
  SimSeat(SimRobot& robot, std::string team, const FieldModel& field, Stage* stage,
          std::shared_ptr<const FieldRegion> region, const Random& random,
          std::function<void(std::string_view)> say);

  const std::string& name() const override { return name_; }
  const std::string& team() const override { return team_; }
  Timestamp now() const override { return now_; }
  SensorContainer& container() override { return robot_.container(); }
  RobotCommands& robot() override { return robot_.voice(); }
  const RobotAbilities& abilities() const override { return abilities_; }
  const FieldModel& field() const override { return field_; }
  const Taught& taught() const override { return taught_; }
  const Game& game() const override { return game_; }
  Random& random() override { return random_; }
  void say(std::string_view text) override { say_(text); }
  std::span<const Heard> heard() const override { return heard_; }
  Stage* stage() override { return stage_; }

  // --- for the supervisor
  SimRobot& simRobot() { return robot_; }
  void setTime(Timestamp now) { now_ = now; }
  void setGame(const Game& game) {
    if (!(game == game_)) game_ = game;
  }
  void hear(const Heard& message) { keepHeard(heard_, message); }
  void forgetHeard() { heard_.clear(); }

 private:
  SimRobot& robot_;
  std::string name_;  ///< copy of the name, which outlives the robot
  std::string team_;
  const FieldModel& field_;
  Stage* stage_;
  Taught taught_;
  Random random_;
  std::function<void(std::string_view)> say_;
  RobotAbilities abilities_;
  Game game_;
  Timestamp now_ = 0;
  std::vector<Heard> heard_;
};

}  // namespace ortung
