#pragma once

#include <algorithm>
#include <cmath>

#include "RunResult.hpp"

namespace ortung::app {

/// A run of 60 s on a circle of 2 m in an 8 x 6 m hall with a pillar: 0.5 m off for 5 s, then
/// 0.1 m and 1 degree.
inline RunResult syntheticRun() {
  constexpr double kPi = 3.14159265358979323846;
  RunResult run;
  run.figures.source = "record:circle.rec";
  run.figures.steps = 600;
  run.figures.atCorrections.compared = 600;
  run.figures.overTime.compared = 600;
  run.figures.duration = 60.0;
  run.figures.particlesMean = 1234.0;
  run.figures.overTime.positionRmse = 0.1;
  run.figures.overTime.positionMedian = 0.1;
  run.figures.overTime.positionP95 = 0.11;
  run.figures.overTime.headingRmse = kPi / 180.0;
  run.figures.convergedAfter = 5.0;
  run.figures.updateMsP50 = 0.25;
  run.figures.updateMsP99 = 0.5;
  run.figures.realtimeFactor = 300.0;
  run.figures.overTime.neesMean = 2.9;
  for (int i = 0; i < 600; ++i) {
    const double t = 0.1 * i;
    const double angle = 0.2 * t;
    const double off = t < 5.0 ? 0.5 : 0.1 + 0.01 * std::sin(3.0 * t);
    EvaluationPoint point;
    point.stamp = fromSeconds(t);
    point.truth = {2.0 * std::cos(angle), 2.0 * std::sin(angle), wrapAngle(angle + kPi / 2)};
    point.estimate = {(2.0 + off) * std::cos(angle), (2.0 + off) * std::sin(angle),
                      wrapAngle(angle + kPi / 2 + kPi / 180)};
    point.positionError = off;
    point.headingError = kPi / 180.0;
    point.samples = t < 5.0 ? 20000 : 500;
    point.covariance = {0.004, 0, 0, 0, 0.004, 0, 0, 0, 0.0004};
    run.figures.points.push_back(point);
    PoseEstimate estimate;
    estimate.stamp = point.stamp;
    estimate.pose = point.estimate;
    estimate.covariance = point.covariance;
    estimate.samples = point.samples;
    run.estimates.push_back(estimate);
  }
  run.path = run.estimates;
  run.seed = 7;
  run.particles = 20000;
  run.robot = "robot.toml";
  run.tables = "hall.ortung";
  run.commandLine = "ortung eval --source record:circle.rec";
  run.tableInfo.world = "hall";
  run.tableInfo.worldFingerprint = "0123456789abcdef";
  FieldRegion& region = run.tableInfo.region;
  region.grid = {-4.0, -3.0, 0.1, 80, 60};
  for (std::size_t cell = 0; cell < region.grid.size(); ++cell) {
    const double x = region.grid.centreX(cell);
    const double y = region.grid.centreY(cell);
    const double room = std::min({4.0 - std::abs(x), 3.0 - std::abs(y), std::hypot(x, y) - 0.6});
    region.open.push_back(room > 0.0);
    region.standable.push_back(room > 0.25);
  }
  return run;
}

}  // namespace ortung::app
