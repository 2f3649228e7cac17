#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "ortung/base/Parameters.hpp"
#include "ortung/sim_api/Game.hpp"
#include "ortung/sim_api/Stage.hpp"

namespace ortung::test {

/// What must hold at a moment (docs/referee.md).
struct Expectation {
  struct Robot {
    std::string name;
    std::optional<FloorPoint> place;  ///< [m]
    std::optional<double> fromBall;   ///< at least, edge to edge [m]
    std::optional<bool> isInOwnHalf;
  };
  std::optional<Game::Phase> phase;
  std::optional<Game::Restart> restart;
  std::optional<std::string> restartOf;  ///< "": of both
  std::optional<std::array<int, 2>> score;
  std::optional<int> half;
  std::optional<double> clock;      ///< [s], within a cycle
  std::optional<std::string> left;  ///< team on the left
  std::optional<FloorPoint> ball;   ///< [m]
  std::optional<bool> ballRests;
  double tolerance = 0.05;  ///< of places [m]
  std::vector<Robot> robots;
  std::vector<std::string> held, free;    ///< names of robots
  std::vector<std::string> seen, unseen;  ///< events since the step before: "goal" or "goal blue"
};

struct Step {
  double at = 0.0;  ///< [s]
  int line = 0;     ///< number of the step, from 1
  std::vector<std::string> orders;
  std::optional<std::string> refused;  ///< an order that must be refused
  std::optional<StagedThing> ball;
  std::vector<StagedRobot> robots;  ///< places and velocities; new ones have a team
  std::vector<std::string> leave;
  std::optional<Expectation> expect;
};

/// A scenario of a referee, as its file says it.
struct Scenario {
  std::string name;  ///< of the file
  std::string about;
  std::filesystem::path field;  ///< world file
  double cycle = 0.01;          ///< [s]
  bool isPlaying = false;       ///< the ball is in play at the beginning, no restart is prepared
  Parameters referee;           ///< options of the plugin
  std::optional<StagedThing> ball;
  std::vector<StagedRobot> robots;
  std::vector<Step> steps;

  /// @param maps folder of fields and rules that ship
  /// @throws ConfigError
  static Scenario read(const std::filesystem::path& file, const std::filesystem::path& maps);
};

/// Plays a scenario with the plugin `soccer` on a FakeStage. @returns what was not as expected, one
/// line each @throws ConfigError, PluginError
std::vector<std::string> play(const Scenario& scenario);

}  // namespace ortung::test
