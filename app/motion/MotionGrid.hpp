#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "NetworkTrainer.hpp"
#include "ortung/motion/OdometryTrack.hpp"

namespace ortung::app {

/// Commands and truth of a log, as a motion network needs them.
struct CommandLog {
  OdometryTrack truth;
  std::vector<std::pair<Timestamp, Velocities>> commands;  ///< in force from then on; stamps rise
};

/// A drive without gaps in steps of equal length.
struct MotionGrid {
  std::vector<Pose2> truth;          ///< field frame, at the beginning of each step
  std::vector<Velocities> velocity;  ///< true mean of the last 0.2 s, or the last step
  std::vector<Velocities> command;   ///< in force at the beginning of each step
};

/// @param from, to part of the log, as shares of its time
std::vector<MotionGrid> gridsOf(const CommandLog& log, double step, double from, double to);

/// Input and output of @p network at all steps; steps faster than its limit are left out (truth
/// that jumped).
std::vector<MotionExample> examplesOf(const MotionNetwork& network,
                                      const std::vector<MotionGrid>& grids);

/// The limit of velocities that fits: above all commands, and hardly ever exceeded by the truth.
Velocities limitOf(const std::vector<MotionGrid>& grids);

/// How far predictions are off after a while.
struct PredictionErrors {
  std::size_t count = 0;
  double positionMedian = 0.0;  ///< [m]
  double positionRmse = 0.0;    ///< [m]
  double headingMedian = 0.0;   ///< [rad]
  double headingRmse = 0.0;     ///< [rad]
};

/// Predicts the change of pose over @p steps from step @p at of @p grid on, knowing its state then
/// and the commands up to its end.
using Predictor = std::function<Pose2(const MotionGrid& grid, std::size_t at, std::size_t steps)>;

/// Errors of predictions that begin at every step where the commands before are known.
/// @param before how many steps before must be there
/// @param limit pieces in which the truth is faster are left out
PredictionErrors errorsOf(const Predictor& predict, const std::vector<MotionGrid>& grids,
                          std::size_t steps, std::size_t before, const Velocities& limit);

}  // namespace ortung::app
