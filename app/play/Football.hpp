#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "Benchmark.hpp"
#include "PartSet.hpp"
#include "ortung/benchmark/FootballMatrix.hpp"

namespace ortung::app {

/// Arguments of `ortung benchmark football`.
struct FootballBenchmarkArguments {
  std::vector<std::string> leagues;  ///< none: all
  std::vector<std::string> teams = {"footballer"};
  std::vector<std::string> against;  ///< opponents of all teams; none: each other
  std::vector<std::string> sees;     ///< kinds of perception for each team; none: its own
  std::uint64_t halves = 20;         ///< number of halves of each pair in each league
  double seconds = 0.0;              ///< length of a half [s]; 0: of the league
  std::uint64_t seed = 1;
  unsigned threads = 1;
  std::string shard;           ///< part of the halves, "I/N"; "": all of them
  std::string job;             ///< all options on which the figures depend, as JSON
  std::filesystem::path json;  ///< JSON to write; "": none
  bool force = false;          ///< whether to overwrite files of other kinds
  bool progress = false;
};
int runFootballBenchmark(const FootballBenchmarkArguments& arguments);

/// Does what `ortung benchmark verify` does for a result of football. @param text the file's text
int verifyFootballFile(const BenchmarkVerifyArguments& arguments, std::string_view text);

inline constexpr const char* kFootballParts = "football";  ///< kind of the parts

/// Returns the results of all parts. @throws PartError
FootballMatrix mergeFootballParts(const PartSet& parts);

}  // namespace ortung::app
