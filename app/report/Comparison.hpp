#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "RunFile.hpp"

namespace ortung::app {

/// A figure for which less is better, in all pairs of runs in which both have it.
struct ComparedFigure {
  std::string name;
  std::size_t pairs = 0;
  std::size_t better = 0;     ///< number of pairs in which the second run is better
  std::size_t worse = 0;      ///< number of pairs in which it is worse
  double medianBefore = 0.0;  ///< median of the first runs
  double medianAfter = 0.0;   ///< median of the second runs
  double p = 1.0;             ///< p value of the signed-rank test
};

/// A success that a run has or not, in all pairs.
struct ComparedSuccess {
  std::string name;
  std::size_t pairs = 0;
  std::size_t before = 0;  ///< number of successes of the first runs
  std::size_t after = 0;   ///< number of successes of the second runs
  std::size_t better = 0;  ///< number of pairs in which only the second run succeeded
  std::size_t worse = 0;
  double p = 1.0;  ///< p value of McNemar's exact test
};

/// A pair of runs with a large difference, which is listed.
struct ChangedRun {
  std::string name;
  bool isBetter = false;
  std::string why;
};

/// The comparison of two sets of runs.
struct Comparison {
  std::size_t pairs = 0;
  std::vector<std::string> onlyBefore;  ///< names of runs without a counterpart
  std::vector<std::string> onlyAfter;
  std::vector<ComparedSuccess> successes;
  std::vector<ComparedFigure> figures;
  std::vector<ChangedRun> changed;  ///< pairs with a large difference, the worse ones first
};

/// Compares runs. Runs of the same name are pairs; several of one name are paired in their order.
Comparison compare(const std::vector<FiledRun>& before, const std::vector<FiledRun>& after);

/// The comparison as lines for users.
std::string toText(const Comparison& comparison);
/// The comparison as a JSON object.
std::string toJson(const Comparison& comparison);

}  // namespace ortung::app
