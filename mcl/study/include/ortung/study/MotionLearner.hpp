#pragma once

#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/motion/MotionModel.hpp"
#include "ortung/motion/OdometryTrack.hpp"

namespace ortung {

/// What one log says about motion: odometry, and where the robot truly was.
struct MotionLog {
  OdometryTrack odometry;
  std::vector<std::pair<Timestamp, Pose2>> truth;  ///< field frame; stamps rise
};

/// Changes of pose over the same time, each in the robot's old frame.
struct MotionPair {
  Timestamp begin = 0;
  Timestamp end = 0;
  Pose2 odometry;
  Pose2 truth;
};

struct MotionLearning {
  double interval = 0.5;        ///< of the shortest pairs, at least [s]
  double longestGap = 5.0;      ///< of truth and of odometry within a pair [s]
  double earliestDelay = -0.3;  ///< least delay that is tried [s]
  double latestDelay = 0.6;     ///< greatest one [s]; if it is earliestDelay, no other is tried
};

/// Pairs of one log, drives apart: the end of each pair is the beginning of the next.
/// @param delay odometry is this far ahead of the truth [s]
ORTUNG_API std::vector<std::vector<MotionPair>> motionPairs(const MotionLog& log,
                                                            const MotionLearning& options,
                                                            double delay);

struct LearnedMotion {
  double delay = 0.0;          ///< the most likely one [s]
  double logLikelihood = 0.0;  ///< as of MotionModel::endLearning()
  double undelayed = 0.0;      ///< logLikelihood at a delay of 0 (or what is nearest)
  std::size_t pairs = 0;
  double metres = 0.0;   ///< driven, as truth says
  double radians = 0.0;  ///< turned, as truth says
};

/// Teaches a model what the logs say. The delay of odometry, of which all else depends, is that
/// under which the model explains the pairs best: all are tried in steps of 20 ms.
/// @param make a new model; the best one is given back in @p best
/// @param goOn asked now and then with the share done; false: stops with an empty @p best
/// @throws std::runtime_error if there is too little to learn from
ORTUNG_API LearnedMotion learnMotion(const std::vector<MotionLog>& logs,
                                     const MotionLearning& options,
                                     const std::function<std::unique_ptr<MotionModel>()>& make,
                                     std::unique_ptr<MotionModel>& best,
                                     const std::function<bool(double)>& goOn = {});

}  // namespace ortung
