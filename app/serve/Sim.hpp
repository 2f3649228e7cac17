#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "ServingArguments.hpp"

namespace ortung::app {

/// Arguments of `ortung sim`.
struct SimArguments {
  std::filesystem::path world;                ///< file of a world or a scene
  std::vector<std::filesystem::path> robots;  ///< files of robots that wander about
  std::vector<std::string> players;           ///< players as parsePlayer() reads them
  std::string referee;                        ///< referee as parseReferee() reads it; "": none
  std::string refBox;                         ///< RefBox, HOST[:PORT][@TEAM]; "": none
  double playerBudgetMs = 1000.0;             ///< greatest processor time of a call; 0: unlimited
  std::optional<double> duration;             ///< time [s]; nothing: the scene's, or unlimited
  std::filesystem::path record;               ///< record to write; "": none
  std::filesystem::path trace;                ///< CSV to write; "": none
  std::string recorded;                       ///< name of the robot to record; "": the first
  bool digest = false;                        ///< whether to print a hash of the simulation
  unsigned threads = 1;
  std::uint64_t seed = 1;
  std::optional<double> cycleMs;  ///< duration of a cycle [ms]; nothing: the world's
  bool noNoise = false;
  bool force = false;                 ///< whether to overwrite files of other kinds
  std::vector<std::string> localize;  ///< names of robots to localize for clients; "all"
  std::filesystem::path tables;       ///< tables of these robots; "": they are learned
  ServingArguments serving;
};
int runSim(const SimArguments& arguments);

}  // namespace ortung::app
