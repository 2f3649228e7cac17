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

/// Something that a referee has seen or decided.
struct RefereeEvent {
  Timestamp stamp = 0;
  std::string what;  ///< one word: "goal", "throw-in", "half-time", ...
  std::string team;  ///< whom it is for; "": both or none
  std::string text;  ///< one line for people
};

/// "goal blue: 1 : 0": printable ASCII, at most 400 characters.
ORTUNG_API std::string toText(const RefereeEvent& event);

/// Restricts what robots do by a set of rules (paper, section 2). Its constructor takes its
/// options, `rules` among them, a file. Not thread-safe.
class ORTUNG_API Referee {
 public:
  static constexpr const char* kInterface = "ortung.Referee/" ORTUNG_SIM_API_ABI;
  virtual ~Referee();

  /// Looks at the world once a cycle, after robots have sensed and before players act; it may place
  /// robots and things.
  /// @returns what players and clients are told from now on
  virtual const Game& watch(Stage& stage) = 0;
  /// What has happened since the last call, in the order of time.
  virtual std::vector<RefereeEvent> takeEvents() = 0;
  /// Whether a robot is held: it stands where it is until the restart, whatever it is told.
  virtual bool holds(std::string_view robot) const = 0;
  /// A person, or a referee box, orders: "start", "stop", "kick-off blue", "goal yellow", ...
  /// @throws std::invalid_argument for an order that is none, with those that there are
  virtual void order(std::string_view order) = 0;
};

}  // namespace ortung
