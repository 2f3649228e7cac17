#pragma once

#include "ortung/sim_api/Player.hpp"

namespace ortung::test {

/// A seat on the first robot of a stage, without sensors, team mates and referee.
struct SeatOnStage : PlayerSeat {
  /// @param given, commanded borrowed
  SeatOnStage(Stage& given, RobotCommands& commanded, std::uint64_t seed)
      : shown(given), told(commanded), chance(seed) {}

  const std::string& name() const override { return shown.robots().front().name; }
  const std::string& team() const override { return shown.robots().front().team; }
  Timestamp now() const override { return shown.now(); }
  SensorContainer& container() override { return sensors; }
  RobotCommands& robot() override { return told; }
  const RobotAbilities& abilities() const override { return able; }
  const FieldModel& field() const override { return known; }
  const Game& game() const override { return free; }
  Random& random() override { return chance; }
  void say(std::string_view) override {}
  std::span<const Heard> heard() const override { return {}; }
  Stage* stage() override { return &shown; }

  Stage& shown;
  RobotCommands& told;
  SensorContainer sensors;
  RobotAbilities able;
  FieldModel known;
  Game free;
  Random chance;
};

}  // namespace ortung::test
