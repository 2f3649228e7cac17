#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

#include "ortung/base/Export.hpp"
#include "ortung/core/PluginGuard.hpp"
#include "ortung/sim_api/Player.hpp"

namespace ortung {

/// The way into one player, for whoever supervises it: tells what it throws, and when it computes
/// for longer than it may. One thread calls the player, and its time counts.
class ORTUNG_API PlayerGuard {
 public:
  /// @param budget of a processor's time for one call [s]; 0: as long as it likes
  PlayerGuard(const std::string& plugin, const std::string& robot, double budget);
  ~PlayerGuard();
  PlayerGuard(const PlayerGuard&) = delete;
  PlayerGuard& operator=(const PlayerGuard&) = delete;

  /// @param what name of the player's function; text that lives on
  /// @returns why the player must be stopped; "" if nothing is wrong
  template <class Call>
  std::string operator()(const char* what, Call&& call) const {
    const double before = budget_ > 0.0 ? processorTime() : 0.0;
    try {
      guard_(what, std::forward<Call>(call));
    } catch (const PluginFailure& failure) {
      return failure.what();
    }
    return budget_ > 0.0 ? overdue(what, processorTime() - before) : "";
  }

 private:
  static double processorTime();
  std::string overdue(const char* what, double taken) const;

  std::string who_;
  double budget_;
  PluginGuard guard_;
};

/// What a player wants before it takes its seat.
struct PlayerNeeds {
  std::filesystem::path robotFile;  ///< empty: whoever starts it says which
  double period = 0.0;              ///< [s]
  bool stage = false;
  bool tables = false;
  bool pictures = false;
};
/// Asks it. @throws PluginFailure that names it for what it throws and for a period that is none
ORTUNG_API PlayerNeeds needsOf(const Player& player, const std::string& plugin);

/// @throws std::invalid_argument for what PlayerSeat::say() refuses
ORTUNG_API void checkSaid(std::string_view text);

}  // namespace ortung
