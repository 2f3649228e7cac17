#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace ortung::app {

struct GoalkeeperBenchmarkArguments {
  std::vector<std::string> keepers;   ///< policies, or players as parsePlayer() reads them
  std::vector<std::string> strikers;  ///< kinds, or players
  std::vector<std::string> sees;      ///< ways to see that each keeper plays with; none: its own
  std::uint64_t episodes = 1000;      ///< of each pair
  std::uint64_t seed = 1;
  unsigned threads = 1;
  std::string shard = "1/1";   ///< "I/N"
  std::filesystem::path json;  ///< "" for none
  std::filesystem::path html;  ///< "" for none
  bool force = false;          ///< overwrite files of other kinds
  bool progress = false;
};
int runGoalkeeperBenchmark(const GoalkeeperBenchmarkArguments& arguments);

struct BenchmarkVerifyArguments {
  std::filesystem::path file;
  std::uint64_t sample = 500;  ///< episodes of all pairs together
  std::uint64_t seed = 1;      ///< of the choice
  unsigned threads = 1;
  bool progress = false;
};
int runBenchmarkVerify(const BenchmarkVerifyArguments& arguments);

struct BenchmarkMergeArguments {
  std::vector<std::filesystem::path> files;
  std::filesystem::path json;  ///< "" for none
  std::filesystem::path html;  ///< "" for none
  bool force = false;          ///< overwrite files of other kinds
};
int runBenchmarkMerge(const BenchmarkMergeArguments& arguments);

}  // namespace ortung::app
