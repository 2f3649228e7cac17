#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/benchmark/GoalEpisodes.hpp"
#include "ortung/benchmark/Rates.hpp"

namespace ortung {

class PluginFactory;
struct PlayerWish;

/// The episodes of a matrix: every keeper plays against every striker in the same situations.
struct ORTUNG_API GoalMatrixConfig {
  std::vector<std::string> keepers;   ///< keepers as texts for parsePlayer()
  std::vector<std::string> strikers;  ///< strikers as texts for parsePlayer()
  std::uint64_t episodes = 1000;      ///< number of episodes of each pair, over all shards
  std::uint64_t seed = 1;
  /// This shard, which plays the episodes whose number is shard - 1 modulo shards.
  std::uint64_t shard = 1;
  std::uint64_t shards = 1;  ///< number of shards; 1: all episodes are played
  /// Checks it. @throws std::invalid_argument naming the field, its value and what was expected
  void check() const;
  bool operator==(const GoalMatrixConfig&) const = default;
};

/// How a matrix is computed; the results do not depend on it.
struct GoalMatrixRun {
  unsigned threads = 1;
  /// Called by the calling thread with the share that is done; false ends the run. May be empty.
  std::function<bool(double)> goesOn = {};
  /// Table store of the field, shared by several runs; null: each run learns its own.
  std::shared_ptr<TableStore> tables = nullptr;
};

/// A player's pose error over the episodes in which it reported its pose.
struct ErrorSummary {
  std::uint64_t episodes = 0;  ///< number of these episodes
  double mean = 0.0;           ///< mean over the episodes' mean errors of position [m]
  double median = 0.0;         ///< median of the episodes' mean errors of position [m]
  double meanHeading = 0.0;    ///< mean of the episodes' mean errors of heading [rad]
  double medianHeading = 0.0;  ///< median of the episodes' mean errors of heading [rad]
};

/// All episodes of one keeper against one striker.
struct ORTUNG_API GoalCell {
  std::string keeper;
  std::string striker;
  std::vector<GoalEpisode> episodes;  ///< episodes by number; in a shard only its own

  /// Returns the number of episodes with this outcome.
  std::uint64_t count(GoalOutcome outcome) const;
  /// Returns the striker's share of goals with its 95 % interval (Wilson).
  Interval scoring() const { return wilson(count(GoalOutcome::kGoal), episodes.size()); }
  std::optional<double> meanTimeToScore() const;  ///< mean time of goals [s]; nothing: no goal
  /// Return the pose errors; nothing if the player reported no pose in any episode.
  std::optional<ErrorSummary> keeperError() const;
  std::optional<ErrorSummary> strikerError() const;
  /// Returns a digest of the bits of all episodes: a sum, so that those of the shards add up to
  /// that of all.
  std::uint64_t hash(const GoalMatrixConfig& config) const;
};

/// The results of a run.
struct ORTUNG_API GoalMatrix {
  GoalMatrixConfig config;
  std::string world;  ///< digest of the world
  /// Cells: all strikers of the first keeper, then of the second, ...
  std::vector<GoalCell> cells;

  const GoalCell& cell(std::size_t keeper, std::size_t striker) const {
    return cells[keeper * config.strikers.size() + striker];
  }
  /// Returns by how much the striker's share of goals is higher against one keeper than against
  /// another, in the same situations.
  Interval difference(std::size_t keeper, std::size_t other, std::size_t striker) const;
  /// Returns the keeper with which a keeper is compared: the preceding one that differs in the
  /// option `sees` alone, otherwise the first one.
  std::size_t baselineOf(std::size_t keeper) const;
};

/// Return the short names of the goalkeeper's policies and of the strikers' kinds, in their order.
ORTUNG_API std::span<const std::string_view> goalkeeperPolicies();
ORTUNG_API std::span<const std::string_view> strikerKinds();
/// Return the text for parsePlayer() of a short name: "blocking:delay_s=0.1" becomes
/// "goalkeeper:policy=blocking&delay_s=0.1"; others stay as they are.
ORTUNG_API std::string keeperText(const std::string& name);
ORTUNG_API std::string strikerText(const std::string& name);
/// Returns the short name of such a text, for users.
ORTUNG_API std::string shortName(const std::string& text);
/// Makes a keeper or striker.
/// @throws PluginError if its plugin is not there; it lists the short names, the nearest one first
/// @throws ConfigError for options that it does not take
ORTUNG_API std::unique_ptr<Player> makeGoalPlayer(PluginFactory& factory, const PlayerWish& wish);
/// Returns the same keeper with another option `sees`.
ORTUNG_API std::string withSight(const std::string& keeper, const std::string& sees);

/// Plays all episodes of a matrix or of a shard.
/// @throws std::invalid_argument for a bad config; what GoalEpisodes::play() throws;
///   std::runtime_error if goesOn() ended it
ORTUNG_API GoalMatrix playMatrix(const GoalMatrixConfig& config, const GoalMatrixRun& run);
/// Merges all shards into one matrix. @throws std::invalid_argument if they are not the shards of
/// one
ORTUNG_API GoalMatrix mergeShards(std::span<const GoalMatrix> shards);

/// An episode whose result differs from that in a file.
struct GoalMismatch {
  std::string keeper;
  std::string striker;
  std::uint64_t number = 0;
  GoalEpisode told;   ///< the result in the file
  GoalEpisode found;  ///< the result when it was played again
};
/// Plays some episodes of a matrix again, drawn by a seed: from each cell as many as from the
/// others, or one more. @returns those that differ
/// @param sample number of episodes over all cells; if there are fewer, all of them
/// @param played out: number of episodes that were played
ORTUNG_API std::vector<GoalMismatch> verify(const GoalMatrix& matrix, std::uint64_t sample,
                                            std::uint64_t seed, const GoalMatrixRun& run,
                                            std::uint64_t& played);

/// Writes JSON with everything that is needed to play the matrix again. @param version the
/// program's version
ORTUNG_API std::string toJson(const GoalMatrix& matrix, std::string_view version);
/// Reads what toJson() has written. @param name the file's name for error messages
/// @throws std::runtime_error for another file, or one whose figures are inconsistent
ORTUNG_API GoalMatrix readGoalMatrix(std::string_view json, const std::string& name);
/// Computes all figures of a file anew from its episodes: counts, rates, times, differences,
/// ratings.
/// @param json the text of which readGoalMatrix() has made the matrix
/// @returns a sentence for each one that differs by more than a millionth, is missing or unknown;
///   the version alone may be any
ORTUNG_API std::vector<std::string> wrongFigures(std::string_view json, const GoalMatrix& matrix);
/// Writes tables for users: scoring rates with intervals, time to score, paired differences.
ORTUNG_API std::string toText(const GoalMatrix& matrix);

}  // namespace ortung
