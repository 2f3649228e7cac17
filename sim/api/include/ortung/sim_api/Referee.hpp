#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/sim_api/Abi.hpp"
#include "ortung/sim_api/Game.hpp"
#include "ortung/sim_api/Stage.hpp"

namespace ortung {

/// An event that a referee has observed or a decision that it has made.
struct RefereeEvent {
  Timestamp stamp = 0;  ///< time of the event [us]
  std::string what;     ///< kind of event in one word: "goal", "throw-in", "half-time", ...
  std::string team;     ///< the team that it concerns; "": both or none
  std::string text;     ///< description in one line
};

/// Writes an event as "goal blue: 1 : 0": printable ASCII, at most 400 characters.
ORTUNG_API std::string toText(const RefereeEvent& event);

/// Restricts what robots do by a set of rules (paper, section 2). Its constructor takes its
/// options, among them the file `rules`. Not thread-safe.
class ORTUNG_API Referee {
 public:
  static constexpr const char* kInterface = "ortung.Referee/" ORTUNG_SIM_API_ABI;
  virtual ~Referee();

  /// Observes the world. It is called once a cycle, after robots have sensed and before players
  /// act; it may place robots and things.
  /// @returns the state of the game that players and clients see from now on
  virtual const Game& watch(Stage& stage) = 0;
  /// Returns the events since the last call, in the order of time.
  virtual std::vector<RefereeEvent> takeEvents() = 0;
  /// Returns whether a robot is held: it stays where it is until the restart, whatever its
  /// commands.
  virtual bool holds(std::string_view robot) const = 0;
  /// Obeys an order of a person or of a referee box: "start", "stop", "kick-off blue", "goal
  /// yellow", ...
  /// @throws std::invalid_argument for an unknown order, with a list of those that are known
  virtual void order(std::string_view order) = 0;
};

}  // namespace ortung
