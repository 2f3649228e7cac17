#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

#include "ortung/base/Export.hpp"
#include "ortung/core/PluginGuard.hpp"
#include "ortung/sim_api/Player.hpp"

namespace ortung {

/// Wraps the calls of one player for its supervisor: it reports exceptions, and calls that take
/// more processor time than the budget. It counts the time of the calling thread.
class ORTUNG_API PlayerGuard {
 public:
  /// @param plugin name of the player's plugin @param robot name of its robot
  /// @param budget processor time that one call may take [s]; 0: no limit
  PlayerGuard(const std::string& plugin, const std::string& robot, double budget);
  ~PlayerGuard();
  PlayerGuard(const PlayerGuard&) = delete;
  PlayerGuard& operator=(const PlayerGuard&) = delete;

  /// Calls the player.
  /// @param what name of the player's function; the text must outlive the guard
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

/// What a player needs before it can begin.
struct PlayerNeeds {
  std::filesystem::path robotFile;  ///< its robot file; empty: the user must give one
  double period = 0.0;              ///< time between two calls of senseAndAct() [s]
  bool stage = false;               ///< whether it needs the world's true state
  bool tables = false;              ///< whether it needs tables of its robot
  bool pictures = false;            ///< whether it reads sensors that sense on demand
};
/// Asks a player what it needs. @throws PluginFailure that names the player if it throws or if its
/// period is not in [0, 1e6] s
ORTUNG_API PlayerNeeds needsOf(const Player& player, const std::string& plugin);

/// Checks a message. @throws std::invalid_argument for one that PlayerSeat::say() refuses
ORTUNG_API void checkSaid(std::string_view text);

}  // namespace ortung
