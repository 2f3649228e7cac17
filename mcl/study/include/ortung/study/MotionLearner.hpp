#pragma once

#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/motion/MotionModel.hpp"
#include "ortung/motion/OdometryTrack.hpp"

namespace ortung {

/// The data of one log about motion: odometry, and the robot's true poses.
struct MotionLog {
  OdometryTrack odometry;                          ///< odometry's poses by time
  std::vector<std::pair<Timestamp, Pose2>> truth;  ///< true poses in the field frame; stamps rise
};

/// Changes of pose over the same time, each in the robot's frame at its begin.
struct MotionPair {
  Timestamp begin = 0;  ///< beginning of the time [us]
  Timestamp end = 0;    ///< end of the time [us]
  Pose2 odometry;       ///< change by odometry
  Pose2 truth;          ///< true change
};

/// Options of learning motion.
struct MotionLearning {
  double interval = 0.5;        ///< least time of the shortest pairs [s]
  double longestGap = 5.0;      ///< longest gap of truth and of odometry within a pair [s]
  double earliestDelay = -0.3;  ///< least delay that is tried [s]
  double latestDelay = 0.6;     ///< greatest delay that is tried [s]; may equal earliestDelay
};

/// Returns the pairs of one log by drive: the end of each pair is the beginning of the next.
/// @param delay odometry at the time t - delay is compared with the truth at t [s]
ORTUNG_API std::vector<std::vector<MotionPair>> motionPairs(const MotionLog& log,
                                                            const MotionLearning& options,
                                                            double delay);

/// The result of learning motion.
struct LearnedMotion {
  double delay = 0.0;          ///< most likely delay of odometry [s]
  double logLikelihood = 0.0;  ///< mean ln p of a pair, as MotionModel::endLearning() returns it
  double undelayed = 0.0;      ///< logLikelihood at the delay that is nearest to 0
  std::size_t pairs = 0;       ///< number of pairs
  double metres = 0.0;         ///< true distance travelled [m]
  double radians = 0.0;        ///< true sum of turns [rad]
};

/// Fits a motion model to logs. The delay of odometry, on which all parameters depend, is the one
/// with which the model explains the pairs best: all delays are tried in steps of 20 ms.
/// @param make returns a new model
/// @param best gets the best model
/// @param goOn called from time to time with the share done; false: stops with an empty @p best
/// @throws std::runtime_error if there is too little to learn from
ORTUNG_API LearnedMotion learnMotion(const std::vector<MotionLog>& logs,
                                     const MotionLearning& options,
                                     const std::function<std::unique_ptr<MotionModel>()>& make,
                                     std::unique_ptr<MotionModel>& best,
                                     const std::function<bool(double)>& goOn = {});

}  // namespace ortung
