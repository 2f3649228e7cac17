#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "ortung/base/Time.hpp"
#include "ortung/learning/Environments.hpp"

namespace ortung::learning {

/// The task of an environment: which of the two robots agents drive.
enum class Task : std::uint8_t { kKeep, kStrike, kBoth, kLocalize };

/// What an agent observes.
enum class Sight : std::uint8_t {
  kTruth,     ///< true pose and true ball
  kFeatures,  ///< true pose; ball and other robot as its camera sees them
  kLocalized  ///< pose by MCL on its own sensors; ball and other robot as its camera sees them
};

/// The options of an environment, read and checked.
struct Settings {
  Task task = Task::kKeep;
  Sight sight = Sight::kFeatures;
  std::string keeper;                  ///< the keeper as a player's text; "": an agent drives it
  std::string striker;                 ///< the striker as a player's text; "": an agent drives it
  std::filesystem::path keeperRobot;   ///< robot file of a keeper that is an agent
  std::filesystem::path strikerRobot;  ///< robot file of a striker that is an agent
  double keeperSpeed = 1.5;            ///< the keeper's speed for an action of 1 [m/s]
  double strikerSpeed = 1.0;           ///< the striker's speed for an action of 1 [m/s]
  double cycle = 0.02;                 ///< cycle of the simulation [s]
  int cycles = 5;                      ///< cycles per step
  int steps = 100;                     ///< greatest number of steps of an episode
  bool startsAnywhere = false;         ///< whether MCL begins without a start pose

  double step() const { return cycle * cycles; }
  bool keeperIsAgent() const { return keeper.empty(); }
  bool strikerIsAgent() const { return striker.empty(); }

  /// Reads the options. @throws ConfigError naming the option, its value and what was expected
  static Settings read(const EnvironmentInfo& environment, const Options& options);
};

}  // namespace ortung::learning
