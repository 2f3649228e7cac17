#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "ortung/base/Export.hpp"
#include "ortung/base/Time.hpp"
#include "ortung/benchmark/GoalEpisodes.hpp"
#include "ortung/sim/Scene.hpp"
#include "ortung/sim/TableStore.hpp"

namespace ortung {

class SceneRun;
struct RefereeEvent;

/// The figures of a half. Those of teams are those of the first team, then of the second.
/// Times count while the ball is in play (Game::Phase::kPlaying), docs/matches.md defines them.
struct FootballHalf {
  using OfTeams = std::array<std::int32_t, 2>;
  OfTeams goals{};
  /// Goals that the other team has got without touching the ball in the last two seconds: they are
  /// among the other's goals, too.
  OfTeams ownGoals{};
  OfTeams passes{};               ///< passes that have reached a mate
  std::int32_t stuck = 0;         ///< decisions "ball-stuck"
  std::int32_t late = 0;          ///< restarts that were not taken in time
  Timestamp inPlay = 0;           ///< time for which the ball was in play [us]
  Timestamp unattended = 0;       ///< time in which nobody went for the ball [us]
  Timestamp longestAlone = 0;     ///< longest time in which nobody went for the ball [us]
  Timestamp longestIdle = 0;      ///< longest stand of its team's nearest to the ball [us]
  Timestamp longestStand = 0;     ///< longest stand of any field player [us]
  std::uint32_t digest = 0;       ///< digest of the bits of all poses at the end
  std::array<PoseError, 2> pose;  ///< mean pose errors of the players that report a pose
  bool operator==(const FootballHalf&) const = default;
};

/// Returns the leagues, each with a scene that ships ("LEAGUE_match.toml").
ORTUNG_API std::span<const std::string_view> footballLeagues();

/// A team as users name it: "PLAYER" or "PLAYER+KEEPER", texts for parsePlayer() without name, team
/// and start; without KEEPER it is that of the scene, which sees as the player does.
struct FootballTeam {
  PlayerWish player;
  std::optional<PlayerWish> keeper;
  /// @throws ConfigError
  ORTUNG_API static FootballTeam parse(const std::string& text);
};

/// The tables of the leagues' fields, shared by several threads.
using FootballTables = std::map<std::string, std::shared_ptr<TableStore>>;
ORTUNG_API FootballTables footballTables();

/// Plays halves of two teams. A half is a function of league, teams, seed and number alone:
/// everything is made anew for it. The first team is blue in halves of an even number, yellow in
/// the others; halves of the same seed and number begin alike for all teams. Not thread-safe.
class ORTUNG_API FootballHalves {
 public:
  explicit FootballHalves(FootballTables tables = footballTables());
  ~FootballHalves();
  FootballHalves(const FootballHalves&) = delete;
  FootballHalves& operator=(const FootballHalves&) = delete;

  /// What is to be played.
  struct Order {
    std::string league;
    std::string first;   ///< a team, see FootballTeam
    std::string second;  ///< the other one
    double seconds = 0;  ///< length of the half [s]; 0: as the league's scene has it
    std::uint64_t seed = 1;
    std::uint64_t number = 0;
  };
  /// Called after each cycle with the run and what the referee has said in it.
  using Watch = std::function<void(const SceneRun&, std::span<const RefereeEvent>)>;
  /// Plays a half. @throws ConfigError, PluginError for teams that can't be made;
  /// std::runtime_error with seed and number if a player was stopped
  FootballHalf play(const Order& order, const Watch& watch = {});
  /// Makes the players of both teams without playing. @throws as play()
  void check(const Order& order);
  /// Returns the digest of a league's world. @throws std::invalid_argument for another league
  std::string fingerprint(const std::string& league) const;
  /// Returns the scene of a half, with its teams. @throws as play()
  static Scene sceneOf(const Order& order, PluginFactory& factory);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace ortung
