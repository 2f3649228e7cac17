#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "ortung/mcl/Evaluation.hpp"
#include "ortung/robot/RobotFile.hpp"
#include "ortung/robot/TableInfo.hpp"

namespace ortung::app {

/// One evaluated run with all that it depends on.
struct RunResult {
  EvaluationResult figures;
  Timestamp first = 0;                  ///< of the first reading
  std::vector<PoseEstimate> estimates;  ///< of all updates, also where the truth is not known
  /// What was estimated, in the order of time: at all updates and at the even times at which
  /// figures.points are taken, also where the truth is not known.
  std::vector<PoseEstimate> path;
  std::uint64_t seed = 0;
  std::size_t particles = 0;  ///< most samples
  std::string robot;          ///< file
  std::string tables;         ///< file
  TableInfo tableInfo;
  std::vector<std::string> faults;  ///< that the readings had
  std::string commandLine;
};

/// The figures as a JSON object for machines; what is not a number becomes null. docs/mcl.md tells
/// its keys.
std::string toJson(const RunResult& run);

/// The figures as lines for people.
std::string toText(const RunResult& run);

/// One figure as the summary and the report show it.
struct Figure {
  std::string name;
  std::string value;  ///< with its unit; "-" if there is none
};
std::vector<Figure> figuresOf(const RunResult& run);

}  // namespace ortung::app
