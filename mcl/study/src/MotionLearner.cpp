#include "ortung/study/MotionLearner.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace ortung {
namespace {

constexpr double kDelayStep = 0.02;  // [s]

/// Returns whether odometry is known at @p stamp for every delay that is tried, so that all delays
/// are compared on the same pairs.
bool isCovered(const MotionLog& log, const MotionLearning& options, Timestamp stamp) {
  for (const double delay : {options.earliestDelay, options.latestDelay}) {
    if (!(log.odometry.gapAt(stamp - fromSeconds(delay)) <= options.longestGap)) return false;
  }
  return true;
}

std::vector<double> delaysOf(const MotionLearning& options) {
  const auto first = static_cast<int>(std::ceil(options.earliestDelay / kDelayStep - 1e-9));
  const auto last = static_cast<int>(std::floor(options.latestDelay / kDelayStep + 1e-9));
  std::vector<double> delays;
  for (int k = first; k <= last; ++k) delays.push_back(k * kDelayStep);
  if (delays.empty()) delays.push_back(options.earliestDelay);
  return delays;
}

}  // namespace

std::vector<std::vector<MotionPair>> motionPairs(const MotionLog& log,
                                                 const MotionLearning& options, double delay) {
  std::vector<std::vector<MotionPair>> drives(1);
  const Timestamp interval = fromSeconds(options.interval);
  const Timestamp longest = interval + fromSeconds(options.longestGap);
  std::optional<std::pair<Timestamp, Pose2>> last;
  for (const auto& [stamp, truth] : log.truth) {
    if (last && stamp < last->first + interval) continue;
    if (log.odometry.empty() || !isCovered(log, options, stamp)) {
      last.reset();
      continue;
    }
    if (last && stamp - last->first > longest) last.reset();
    if (!last) {
      if (!drives.back().empty()) drives.emplace_back();
    } else {
      const Timestamp shift = fromSeconds(delay);
      const Pose2 from = *log.odometry.at(last->first - shift);
      const Pose2 to = *log.odometry.at(stamp - shift);
      drives.back().push_back(
          {last->first, stamp, inverse(from) * to, inverse(last->second) * truth});
    }
    last = {stamp, truth};
  }
  if (drives.back().empty()) drives.pop_back();
  return drives;
}

LearnedMotion learnMotion(const std::vector<MotionLog>& logs, const MotionLearning& options,
                          const std::function<std::unique_ptr<MotionModel>()>& make,
                          std::unique_ptr<MotionModel>& best,
                          const std::function<bool(double)>& goOn) {
  LearnedMotion result;
  result.logLikelihood = -std::numeric_limits<double>::infinity();
  double nearest = std::numeric_limits<double>::infinity();
  const std::vector<double> delays = delaysOf(options);
  for (std::size_t i = 0; i < delays.size(); ++i) {
    if (goOn && !goOn(static_cast<double>(i) / static_cast<double>(delays.size()))) {
      best.reset();
      return result;
    }
    std::unique_ptr<MotionModel> model = make();
    result.pairs = 0;
    result.metres = result.radians = 0.0;
    for (const MotionLog& log : logs) {
      for (const auto& drive : motionPairs(log, options, delays[i])) {
        for (const MotionPair& pair : drive) {
          model->learnMotion(pair.odometry, pair.truth);
          ++result.pairs;
          result.metres += std::hypot(pair.truth.x, pair.truth.y);
          result.radians += std::abs(pair.truth.theta);
        }
        model->endDrive();
      }
    }
    const double logLikelihood = model->endLearning();
    if (std::abs(delays[i]) < nearest) {
      nearest = std::abs(delays[i]);
      result.undelayed = logLikelihood;
    }
    if (logLikelihood > result.logLikelihood) {
      result.logLikelihood = logLikelihood;
      result.delay = delays[i];
      best = std::move(model);
    }
  }
  return result;
}

}  // namespace ortung
