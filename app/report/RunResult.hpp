#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "ortung/mcl/MapChanges.hpp"
#include "ortung/robot/RobotFile.hpp"
#include "ortung/robot/TableInfo.hpp"
#include "ortung/study/Evaluation.hpp"
#include "ortung/study/PoseBound.hpp"
#include "ortung/study/RunEvaluation.hpp"

namespace ortung::app {

/// How a run is made from its source.
enum class RunKind : std::uint8_t {
  kWhole,     ///< the source as it is
  kKidnap,    ///< the robot is carried elsewhere once
  kWakeUp,    ///< an unknown start at a random moment
  kTeleports  ///< the robot is carried elsewhere repeatedly
};

/// Returns "whole", "kidnap", "wake-up" or "teleports".
const char* nameOf(RunKind kind);

/// An event after which the robot has to localize globally, and whether it did.
struct CaseEvent {
  double at = 0.0;           ///< time since the run's first reading (wake-up: the source's) [s]
  Pose2 place;               ///< the robot's true pose at that time
  bool isRight = false;      ///< whether the estimate became right
  double after = 0.0;        ///< time until the estimate was right [s]
  double travelled = 0.0;    ///< distance travelled until then [m]
  std::size_t readings = 0;  ///< number of times with readings until then
};

/// MCL compared with the grid filter, after the same readings.
struct GridComparison {
  Timestamp stamp = 0;
  double divergence = 0.0;  ///< divergence of the samples from the grid [nats]
  double distance = 0.0;    ///< distance between the two estimates [m]
};

/// An evaluated run with everything that it depends on.
struct RunResult : EvaluatedRun {
  std::uint64_t seed = 0;
  std::size_t particles = 0;  ///< greatest number of samples
  std::string robot;          ///< robot file
  std::string tables;         ///< table file
  TableInfo tableInfo;
  std::string start;                ///< start of the belief: "global", "truth" or a pose
  std::vector<std::string> faults;  ///< faults of the readings
  std::string commandLine;
  RunKind kind = RunKind::kWhole;
  std::size_t number = 1;                  ///< number among the runs of its kind, from 1
  std::vector<CaseEvent> events;           ///< events of a case
  std::optional<BoundFigures> bound;       ///< Cramer-Rao bound, if it was requested
  std::vector<PoseBound> bounds;           ///< that bound at all times
  std::vector<GridComparison> besideGrid;  ///< comparison at updates, if it was requested
  MapChanges changes;                      ///< where the map no longer fits, at the end
  std::vector<float> errors;               ///< position errors at all times after convergence [m]
};

/// Returns the figures as a JSON object; NaN becomes null. docs/mcl.md describes its keys.
std::string toJson(const RunResult& run);

/// Returns the figures as lines for users.
std::string toText(const RunResult& run);

/// One figure as the summary and the report show it.
struct Figure {
  std::string name;
  std::string value;  ///< value with its unit; "-" if there is none
};
/// Returns the figures of the summary.
std::vector<Figure> figuresOf(const RunResult& run);

}  // namespace ortung::app
