#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/base/Time.hpp"
#include "ortung/benchmark/GoalJudge.hpp"
#include "ortung/sim/TableStore.hpp"
#include "ortung/sim_api/Player.hpp"

namespace ortung {

/// The mean distance between a player's believed pose and its true pose, over all its actions.
struct PoseError {
  static constexpr std::int32_t kNone = -1;  ///< stands for a player that did not report a pose
  std::int32_t position = kNone;             ///< mean error of position [um]
  std::int32_t heading = kNone;              ///< mean error of heading [urad]
  bool operator==(const PoseError&) const = default;
};

/// The result of an episode.
struct GoalEpisode {
  GoalOutcome outcome = GoalOutcome::kTime;
  Timestamp end = 0;         ///< time from its beginning to its end [us]
  std::uint32_t digest = 0;  ///< digest of the bits of all poses at the end
  PoseError keeper = {};     ///< the keeper's pose error
  PoseError striker = {};    ///< the striker's pose error
  bool operator==(const GoalEpisode&) const = default;
};

/// The true state in one cycle of an episode, and the poses that both players believe.
struct GoalMoment {
  Timestamp stamp = 0;  ///< time from the episode's beginning [us]
  Pose2 ball;
  Pose2 keeper;
  Pose2 striker;
  std::optional<BelievedPose> keeperBelieves;
  std::optional<BelievedPose> strikerBelieves;
};

/// Plays episodes between a goalkeeper and a striker on the F2000 field: the keeper defends the
/// goal at negative x from somewhere on its line, the striker makes its situation.
/// An episode is a function of the two players, the seed and its number alone: everything is made
/// anew for it. Situations are paired: episodes of the same seed and number begin alike for all
/// keepers, as far as the striker does not look at the keeper. Not thread-safe: each thread has its
/// own.
class ORTUNG_API GoalEpisodes {
 public:
  /// The longest duration of an episode [us].
  static constexpr Timestamp kLongest = 10'000'000;

  /// @param tables table store of the F2000 field, shared by several threads; null: it makes its
  ///   own
  /// @throws ConfigError for a world that can't be read
  explicit GoalEpisodes(std::shared_ptr<TableStore> tables = nullptr);
  ~GoalEpisodes();
  GoalEpisodes(const GoalEpisodes&) = delete;
  GoalEpisodes& operator=(const GoalEpisodes&) = delete;

  /// Plays an episode.
  /// @param keeper, striker texts for parsePlayer(), without name, team and start
  /// @throws ConfigError, PluginError for players that can't be made
  /// @param watch called after each cycle; may be empty
  /// @throws std::runtime_error with seed and number if a player was stopped
  GoalEpisode play(const std::string& keeper, const std::string& striker, std::uint64_t seed,
                   std::uint64_t number, const std::function<void(const GoalMoment&)>& watch = {});
  /// Makes both players without playing. @throws as play()
  void check(const std::string& keeper, const std::string& striker);
  /// Returns the digest of the world, see SimWorld::fingerprint().
  const std::string& fingerprint() const;
  /// Returns the world file of the field.
  static std::filesystem::path world();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace ortung
