#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace ortung::app {

/// Arguments of `ortung play`.
struct PlayArguments {
  std::string player;              ///< player as parsePlayer() reads it
  std::string server;              ///< address of the server, "HOST:PORT"
  std::filesystem::path tokens;    ///< file with a line 'NAME TOKEN'; "": none
  std::filesystem::path tables;    ///< table file; "": none
  double budgetMs = 1000.0;        ///< greatest processor time of a call [ms]; 0: unlimited
  std::optional<double> duration;  ///< time to play [s]; nothing: until the player ends
  std::uint64_t seed = 1;
  bool lockstep = false;
};
int runPlay(const PlayArguments& arguments);

}  // namespace ortung::app
