#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "Calibration.hpp"
#include "ortung/study/Evaluation.hpp"
#include "ortung/study/PoseBound.hpp"
#include "ortung/robot/RobotFile.hpp"
#include "ortung/robot/TableInfo.hpp"

namespace ortung::app {

/// What a run is made of.
enum class RunKind : std::uint8_t {
  kWhole,     ///< the source as it is
  kKidnap,    ///< the robot is carried elsewhere once
  kWakeUp,    ///< an unknown start at a random moment
  kTeleports  ///< the robot is carried elsewhere again and again
};

/// "whole", "kidnap", "wake-up" or "teleports".
const char* nameOf(RunKind kind);

/// Where a robot has to find its place, and whether it did.
struct CaseEvent {
  double at = 0.0;  ///< since the run's first reading; of a wake-up: since the source's [s]
  Pose2 place;      ///< where it is then
  bool isRight = false;
  double after = 0.0;        ///< if it is: when it became so [s] ...
  double way = 0.0;          ///< ... after how much way [m] ...
  std::size_t readings = 0;  ///< ... and how many moments with readings
};

/// MCL beside the grid filter, after the same readings.
struct GridComparison {
  Timestamp stamp = 0;
  double divergence = 0.0;  ///< of the samples from the grid [nats]
  double distance = 0.0;    ///< of the two estimates [m]
};

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
  std::string start;                ///< "global", "truth" or a pose
  std::vector<std::string> faults;  ///< that the readings had
  std::string commandLine;
  RunKind kind = RunKind::kWhole;
  std::size_t number = 1;                  ///< of its kind, from 1
  std::vector<CaseEvent> events;           ///< of a case
  std::vector<float> updateMs;             ///< of all updates
  Calibration calibration;                 ///< of the claimed quality
  std::optional<BoundFigures> bound;       ///< of the same run, if it was asked for
  std::vector<PoseBound> bounds;           ///< of all its moments then
  std::vector<GridComparison> besideGrid;  ///< of updates, if it was asked for
  std::vector<float> errors;  ///< of the positions of all moments after convergence [m]
};

/// How well the filter's claim that a position is right to 0.5 m fits what came of it.
Calibration calibrationOf(const std::vector<EvaluationPoint>& points);

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
