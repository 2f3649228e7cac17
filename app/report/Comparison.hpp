#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "RunFile.hpp"

namespace ortung::app {

/// A figure of which less is better, in all pairs of runs in which it is known both times.
struct ComparedFigure {
  std::string name;
  std::size_t pairs = 0;
  std::size_t better = 0;  ///< the second one is
  std::size_t worse = 0;
  double medianBefore = 0.0;
  double medianAfter = 0.0;
  double p = 1.0;  ///< of the signed-rank test
};

/// Something that succeeds or not.
struct ComparedSuccess {
  std::string name;
  std::size_t pairs = 0;
  std::size_t before = 0;  ///< successes
  std::size_t after = 0;
  std::size_t better = 0;  ///< only the second one succeeded
  std::size_t worse = 0;
  double p = 1.0;  ///< of McNemar's exact test
};

/// A pair of runs that differ by so much that one would want to know.
struct ChangedRun {
  std::string name;
  bool isBetter = false;
  std::string why;
};

struct Comparison {
  std::size_t pairs = 0;
  std::vector<std::string> onlyBefore;  ///< names of runs without a counterpart
  std::vector<std::string> onlyAfter;
  std::vector<ComparedSuccess> successes;
  std::vector<ComparedFigure> figures;
  std::vector<ChangedRun> changed;  ///< worse ones first
};

/// Runs of the same name are pairs, in their order if there are several.
Comparison compare(const std::vector<FiledRun>& before, const std::vector<FiledRun>& after);

std::string toText(const Comparison& comparison);
std::string toJson(const Comparison& comparison);

}  // namespace ortung::app
