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

/// How far a player believed to be from where it was, on average over when it acted.
struct PoseError {
  static constexpr std::int32_t kNone = -1;  ///< it did not say where it believed to be
  std::int32_t position = kNone;             ///< [um]
  std::int32_t heading = kNone;              ///< [urad]
  bool operator==(const PoseError&) const = default;
};

/// What became of one episode.
struct GoalEpisode {
  GoalOutcome outcome = GoalOutcome::time;
  Timestamp end = 0;         ///< after its beginning [us]
  std::uint32_t digest = 0;  ///< of the bits of where everything was at the end
  PoseError keeper = {};
  PoseError striker = {};
  bool operator==(const GoalEpisode&) const = default;
};

/// One cycle of an episode, as it really was.
struct GoalMoment {
  Timestamp stamp = 0;
  Pose2 ball;
  Pose2 keeper;
  Pose2 striker;
  std::optional<BelievedPose> keeperBelieves;
  std::optional<BelievedPose> strikerBelieves;
};

/// Plays episodes between a goalkeeper and a striker on the F2000 field: the keeper defends the
/// goal at negative x from somewhere on its line, the striker makes its situation.
///
/// An episode is a function of the two players, the seed and its number alone: everything is made
/// anew for it. Situations are paired: whoever keeps, the same seed and number begin alike, as far
/// as the striker does not look at the keeper. Not thread-safe: each thread has its own.
class ORTUNG_API GoalEpisodes {
 public:
  /// What an episode lasts at most [us].
  static constexpr Timestamp kLongest = 10'000'000;

  /// @param tables of the F2000 field, shared by several threads; null: its own
  /// @throws ConfigError for a world that can't be read
  explicit GoalEpisodes(std::shared_ptr<TableStore> tables = nullptr);
  ~GoalEpisodes();
  GoalEpisodes(const GoalEpisodes&) = delete;
  GoalEpisodes& operator=(const GoalEpisodes&) = delete;

  /// @param keeper, striker as parsePlayer() reads them; name, team and start are not theirs to say
  /// @throws ConfigError, PluginError for players that can't be made
  /// @param watch told of each cycle; may be empty
  /// @throws std::runtime_error with seed and number for one that was stopped
  GoalEpisode play(const std::string& keeper, const std::string& striker, std::uint64_t seed,
                   std::uint64_t number, const std::function<void(const GoalMoment&)>& watch = {});
  /// Makes both players without playing. @throws as play()
  void check(const std::string& keeper, const std::string& striker);
  /// Of the world, see SimWorld::fingerprint().
  const std::string& fingerprint() const;
  /// The file of the field.
  static std::filesystem::path world();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace ortung
