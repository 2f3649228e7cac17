#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace ortung::app {

struct PlayArguments {
  std::string player;              ///< as parsePlayer() reads it
  std::string server;              ///< "HOST:PORT"
  std::filesystem::path tokens;    ///< with a line 'NAME TOKEN'; "" for none
  std::filesystem::path tables;    ///< "" for none
  double budgetMs = 1000.0;        ///< of a processor's time for one call; 0: none
  std::optional<double> duration;  ///< [s]; default: as long as the player likes
  std::uint64_t seed = 1;
  bool lockstep = false;
};
int runPlay(const PlayArguments& arguments);

}  // namespace ortung::app
