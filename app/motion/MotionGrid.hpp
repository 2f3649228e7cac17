#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "NetworkTrainer.hpp"
#include "ortung/motion/OdometryTrack.hpp"

namespace ortung::app {

/// Commands and ground truth of a log, for a motion network.
struct CommandLog {
  OdometryTrack truth;
  std::vector<std::pair<Timestamp, Velocities>> commands;  ///< commands, in force from a time on
};

/// A drive without gaps, sampled at equal time steps.
struct MotionGrid {
  std::vector<Pose2> truth;          ///< pose in the field frame at the begin of each step
  std::vector<Velocities> velocity;  ///< true mean velocity of the last 0.2 s, or last step
  std::vector<Velocities> command;   ///< command in force at the begin of each step
};

/// Samples a log; a gap begins a new grid.
/// @param step time step [s]
/// @param from, to part of the log that is used, as shares of its time
std::vector<MotionGrid> gridsOf(const CommandLog& log, double step, double from, double to);

/// Returns input and output of @p network at all steps; steps faster than its limit, in which the
/// truth jumped, are left out.
std::vector<MotionExample> examplesOf(const MotionNetwork& network,
                                      const std::vector<MotionGrid>& grids);

/// Returns limits of velocities that are above all commands and almost all true velocities.
Velocities limitOf(const std::vector<MotionGrid>& grids);

/// Errors of predicted poses after some steps.
struct PredictionErrors {
  std::size_t count = 0;        ///< number of predictions
  double positionMedian = 0.0;  ///< median position error [m]
  double positionRmse = 0.0;    ///< RMS position error [m]
  double headingMedian = 0.0;   ///< median heading error [rad]
  double headingRmse = 0.0;     ///< RMS heading error [rad]
};

/// Predicts the change of pose over @p steps from step @p at of @p grid on, knowing its state then
/// and the commands up to its end.
using Predictor = std::function<Pose2(const MotionGrid& grid, std::size_t at, std::size_t steps)>;

/// Computes the errors of predictions from every step for which the commands before it are known.
/// @param steps number of steps that are predicted
/// @param before number of steps that must precede the first one
/// @param limit velocities; pieces in which the truth is faster are left out
PredictionErrors errorsOf(const Predictor& predict, const std::vector<MotionGrid>& grids,
                          std::size_t steps, std::size_t before, const Velocities& limit);

}  // namespace ortung::app
