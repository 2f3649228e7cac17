#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace ortung::app {

/// Arguments of `ortung benchmark goalkeeper`.
struct GoalkeeperBenchmarkArguments {
  std::vector<std::string> keepers;   ///< policies, or players as parsePlayer() reads them
  std::vector<std::string> strikers;  ///< kinds of strikers, or players
  std::vector<std::string> sees;      ///< kinds of perception for each keeper; none: its own
  std::uint64_t episodes = 1000;      ///< number of episodes of each pair
  std::uint64_t seed = 1;
  unsigned threads = 1;
  std::string shard;           ///< part of the episodes, "I/N"; "": all of them
  std::string job;             ///< all options on which the figures depend, as JSON
  std::filesystem::path json;  ///< JSON to write; "": none
  std::filesystem::path html;  ///< HTML to write; "": none
  bool force = false;          ///< whether to overwrite files of other kinds
  bool progress = false;
};
int runGoalkeeperBenchmark(const GoalkeeperBenchmarkArguments& arguments);

/// Arguments of `ortung benchmark verify`.
struct BenchmarkVerifyArguments {
  std::filesystem::path file;
  std::uint64_t sample = 500;  ///< number of episodes of all pairs together
  std::uint64_t seed = 1;      ///< seed of the choice
  unsigned threads = 1;
  bool progress = false;
};
int runBenchmarkVerify(const BenchmarkVerifyArguments& arguments);

/// Arguments of `ortung benchmark merge`.
struct BenchmarkMergeArguments {
  std::vector<std::filesystem::path> files;
  std::filesystem::path json;  ///< JSON to write; "": none
  std::filesystem::path html;  ///< HTML to write; "": none
  bool force = false;          ///< whether to overwrite files of other kinds
};
/// Does what `ortung merge` does for parts of the benchmark; it was there before.
int runBenchmarkMerge(const BenchmarkMergeArguments& arguments);

}  // namespace ortung::app
