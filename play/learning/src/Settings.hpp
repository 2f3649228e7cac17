#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "ortung/base/Time.hpp"
#include "ortung/learning/Environments.hpp"

namespace ortung::learning {

/// Which of the two robots agents drive.
enum class Task : std::uint8_t { keep, strike, both, localize };

/// What an agent is told.
enum class Sight : std::uint8_t {
  truth,     ///< its pose and the ball as they are
  features,  ///< its pose as it is, the ball and the other robot as its camera sees them
  localized  ///< its pose by MCL on its own sensors, too
};

/// Options of an environment, read and checked.
struct Settings {
  Task task = Task::keep;
  Sight sight = Sight::features;
  std::string keeper;                  ///< a player's text; "": an agent drives it
  std::string striker;                 ///< the same
  std::filesystem::path keeperRobot;   ///< of an agent
  std::filesystem::path strikerRobot;  ///< of an agent
  double keeperSpeed = 1.5;            ///< of an action of 1 [m/s]
  double strikerSpeed = 1.0;           ///< of an action of 1 [m/s]
  double cycle = 0.02;                 ///< of the simulation [s]
  int cycles = 5;                      ///< a step
  int steps = 100;                     ///< an episode has at most
  bool startsAnywhere = false;         ///< MCL is not told where it begins

  double step() const { return cycle * cycles; }
  bool keeperIsAgent() const { return keeper.empty(); }
  bool strikerIsAgent() const { return striker.empty(); }

  /// @throws ConfigError naming the option, its value and what was expected
  static Settings read(const EnvironmentInfo& environment, const Options& options);
};

}  // namespace ortung::learning
