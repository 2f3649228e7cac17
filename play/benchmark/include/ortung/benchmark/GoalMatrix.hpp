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

/// Which episodes a matrix has: every keeper against every striker from the same situations.
struct ORTUNG_API GoalMatrixConfig {
  std::vector<std::string> keepers;   ///< as parsePlayer() reads them
  std::vector<std::string> strikers;  ///< as parsePlayer() reads them
  std::uint64_t episodes = 1000;      ///< of each pair, in all shards together
  std::uint64_t seed = 1;
  std::uint64_t shard = 1;   ///< has the episodes whose number is shard - 1 modulo shards
  std::uint64_t shards = 1;  ///< 1: all
  /// @throws std::invalid_argument naming the field, its value and what was expected
  void check() const;
  bool operator==(const GoalMatrixConfig&) const = default;
};

/// How a run is made; it changes nothing of what comes out.
struct GoalMatrixRun {
  unsigned threads = 1;
  /// Told the share that is done, by the calling thread; false ends the run. May be empty.
  std::function<bool(double)> goesOn = {};
  /// Of the field, for several runs; null: each learns its own.
  std::shared_ptr<TableStore> tables = nullptr;
};

/// How far from the truth a player has believed to be, over the episodes in which it said so.
struct ErrorSummary {
  std::uint64_t episodes = 0;
  double mean = 0.0;           ///< over episodes of an episode's mean [m]
  double median = 0.0;         ///< [m]
  double meanHeading = 0.0;    ///< [rad]
  double medianHeading = 0.0;  ///< [rad]
};

/// All episodes of one keeper against one striker.
struct ORTUNG_API GoalCell {
  std::string keeper;
  std::string striker;
  std::vector<GoalEpisode> episodes;  ///< by number; of a shard only its own

  std::uint64_t count(GoalOutcome outcome) const;
  Interval scoring() const { return wilson(count(GoalOutcome::goal), episodes.size()); }
  std::optional<double> meanTimeToScore() const;  ///< [s]; nothing: no goal
  /// Nothing: no episode in which that player said where it believed to be.
  std::optional<ErrorSummary> keeperError() const;
  std::optional<ErrorSummary> strikerError() const;
  /// Of the bits of all its episodes: sums, so that those of shards add up to that of all.
  std::uint64_t hash(const GoalMatrixConfig& config) const;
};

/// What a run has found.
struct ORTUNG_API GoalMatrix {
  GoalMatrixConfig config;
  std::string world;            ///< fingerprint
  std::vector<GoalCell> cells;  ///< strikers of the first keeper, then of the second, ...

  const GoalCell& cell(std::size_t keeper, std::size_t striker) const {
    return cells[keeper * config.strikers.size() + striker];
  }
  /// How much more the striker scores against one keeper than against another, in the same
  /// situations.
  Interval difference(std::size_t keeper, std::size_t other, std::size_t striker) const;
  /// With whom a keeper is compared: the one before it that differs in the option `sees` alone,
  /// else the first one.
  std::size_t baselineOf(std::size_t keeper) const;
};

/// The short names of the goalkeeper's policies and of the strikers' kinds, in their order.
ORTUNG_API std::span<const std::string_view> goalkeeperPolicies();
ORTUNG_API std::span<const std::string_view> strikerKinds();
/// What parsePlayer() reads: "blocking:delay_s=0.1" is "goalkeeper:policy=blocking&delay_s=0.1";
/// others stay as they are.
ORTUNG_API std::string keeperText(const std::string& name);
ORTUNG_API std::string strikerText(const std::string& name);
/// The other way round, for people.
ORTUNG_API std::string shortName(const std::string& text);
/// The same keeper with another option `sees`.
ORTUNG_API std::string withSight(const std::string& keeper, const std::string& sees);

/// @throws std::invalid_argument for a bad config; what GoalEpisodes::play() throws;
///   std::runtime_error if goesOn() ended it
ORTUNG_API GoalMatrix playMatrix(const GoalMatrixConfig& config, const GoalMatrixRun& run);
/// One matrix of all its shards. @throws std::invalid_argument if they are not that
ORTUNG_API GoalMatrix mergeShards(std::span<const GoalMatrix> shards);

/// An episode that came out otherwise than a file says.
struct GoalMismatch {
  std::string keeper;
  std::string striker;
  std::uint64_t number = 0;
  GoalEpisode told;
  GoalEpisode found;
};
/// Plays some of its episodes again, drawn evenly from each cell by a seed.
/// @param sample of all cells together, at least one of each cell
ORTUNG_API std::vector<GoalMismatch> verify(const GoalMatrix& matrix, std::uint64_t sample,
                                            std::uint64_t seed, const GoalMatrixRun& run,
                                            std::uint64_t& played);

/// JSON with everything that is needed to play it again. @param version of the program
ORTUNG_API std::string toJson(const GoalMatrix& matrix, std::string_view version);
/// @param name what errors call it @throws std::runtime_error for what is no such file, or whose
///   figures do not fit together
ORTUNG_API GoalMatrix readGoalMatrix(std::string_view json, const std::string& name);
/// Tables for people: scoring rates with intervals, time to score, paired differences.
ORTUNG_API std::string toText(const GoalMatrix& matrix);

}  // namespace ortung
