#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Statistics.hpp"
#include "ortung/benchmark/FootballHalf.hpp"

namespace ortung {

/// The halves of a benchmark of football.
struct ORTUNG_API FootballConfig {
  std::vector<std::string> leagues;  ///< leagues, see footballLeagues()
  std::vector<std::string> teams;    ///< teams, see FootballTeam
  /// Opponents of all teams; none: every team plays every other, and a single one itself.
  std::vector<std::string> against = {};
  std::uint64_t halves = 20;  ///< number of halves of each pair in each league, over all shards
  double seconds = 0.0;       ///< length of a half [s]; 0: as the league has it
  std::uint64_t seed = 1;
  /// This shard, which plays the halves whose number is shard - 1 modulo shards.
  std::uint64_t shard = 1;
  std::uint64_t shards = 1;  ///< number of shards; 1: all halves are played
  /// Checks it. @throws std::invalid_argument naming the field, its value and what was expected
  void check() const;
  /// Returns all teams and opponents, each once.
  std::vector<std::string> entrants() const;
  /// Returns the pairs of a league, as indices of entrants().
  std::vector<std::pair<std::size_t, std::size_t>> pairs() const;
  bool operator==(const FootballConfig&) const = default;
};

/// Returns the same team with another option `sees`.
ORTUNG_API std::string withTeamSight(const std::string& team, const std::string& sees);

/// All halves of a pair of teams in a league.
struct ORTUNG_API FootballCell {
  std::string league;
  std::size_t first = 0;             ///< index of the first team in FootballConfig::entrants()
  std::size_t second = 0;            ///< index of the other one
  std::vector<FootballHalf> halves;  ///< halves by number; in a shard only its own

  /// Returns the mean of a figure of a half with its 95 % interval, by bootstrap over the halves.
  Interval mean(const std::function<double(const FootballHalf&)>& figure, std::uint64_t seed) const;
  /// Returns a digest of all halves: a sum, so that those of the shards add up to that of all.
  std::uint64_t hash(const FootballConfig& config) const;
};

/// The results of a run.
struct ORTUNG_API FootballMatrix {
  FootballConfig config;
  std::vector<std::string> worlds;  ///< digests of the leagues' worlds
  std::vector<FootballCell> cells;  ///< all pairs of the first league, then of the second, ...
};

/// How a matrix is computed; the results do not depend on it.
struct FootballRun {
  unsigned threads = 1;
  /// Called by the calling thread with the share that is done; false ends the run. May be empty.
  std::function<bool(double)> goesOn = {};
};

/// Plays all halves of a benchmark or of a shard.
/// @throws std::invalid_argument for a bad config; what FootballHalves::play() throws;
///   std::runtime_error if goesOn() ended it
ORTUNG_API FootballMatrix playFootball(const FootballConfig& config, const FootballRun& run);
/// Merges all shards. @throws std::invalid_argument if they are not the shards of one run
ORTUNG_API FootballMatrix mergeFootball(std::span<const FootballMatrix> shards);

/// A half whose result differs from that in a file.
struct FootballMismatch {
  std::size_t cell = 0;  ///< index in FootballMatrix::cells
  std::uint64_t number = 0;
  FootballHalf told;   ///< the result in the file
  FootballHalf found;  ///< the result when it was played again
};
/// Plays some halves again, drawn evenly from each cell by a seed. @returns those that differ
/// @param sample number of halves over all cells, at least one of each cell
/// @param played out: number of halves that were played
ORTUNG_API std::vector<FootballMismatch> verifyFootball(const FootballMatrix& matrix,
                                                        std::uint64_t sample, std::uint64_t seed,
                                                        const FootballRun& run,
                                                        std::uint64_t& played);

/// Returns whether a text begins like what toJson() has written of a football benchmark.
ORTUNG_API bool isFootballJson(std::string_view json);
/// Writes JSON with everything that is needed to play the halves again. @param version the
/// program's version
ORTUNG_API std::string toJson(const FootballMatrix& matrix, std::string_view version);
/// Reads what toJson() has written. @param name the file's name for error messages
/// @throws std::runtime_error for another file, or one whose figures are inconsistent
ORTUNG_API FootballMatrix readFootball(std::string_view json, const std::string& name);
/// Returns which figures of a file are not those of its halves, a sentence each.
/// @param json what readFootball() has read @param matrix what it has returned
ORTUNG_API std::vector<std::string> wrongFigures(std::string_view json,
                                                 const FootballMatrix& matrix);
/// Writes tables for users: figures of each pair, and ratings if there are several teams.
ORTUNG_API std::string toText(const FootballMatrix& matrix);

}  // namespace ortung
