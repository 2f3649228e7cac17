#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "ServingArguments.hpp"

namespace ortung::app {

struct SimArguments {
  std::filesystem::path world;                ///< a world or a scene
  std::vector<std::filesystem::path> robots;  ///< robot files: they wander about
  std::vector<std::string> players;           ///< as parsePlayer() reads them
  std::string referee;                        ///< as parseReferee() reads it; "": nobody
  std::string refBox;                         ///< HOST[:PORT][@TEAM]; "": none
  double playerBudgetMs = 1000.0;             ///< of a processor's time for one call; 0: none
  std::optional<double> duration;             ///< [s]; default: the scene's, or until a signal
  std::filesystem::path record;               ///< record to write; "": none
  std::filesystem::path trace;                ///< CSV to write; "": none
  std::string recorded;                       ///< name of the robot to record; "": the first
  bool digest = false;                        ///< print a hash of all that happened
  unsigned threads = 1;
  std::uint64_t seed = 1;
  std::optional<double> cycleMs;  ///< default: the world's
  bool noNoise = false;
  bool force = false;                 ///< whether to overwrite files of other kinds
  std::vector<std::string> localize;  ///< names of robots to localize for clients; "all"
  std::filesystem::path tables;       ///< for that; "": they are learned
  ServingArguments serving;
};
int runSim(const SimArguments& arguments);

}  // namespace ortung::app
