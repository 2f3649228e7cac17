#include "ortung/core/Weigher.hpp"

#include <cassert>
#include <cmath>

namespace ortung {

Weigher::~Weigher() = default;

double Weigher::getProbability(const Pose2& pose) const {
  const double logProbability = logProbabilityAt(pose);
  return std::isnan(logProbability) ? kNoExpectation : std::exp(logProbability);
}

void Weigher::getProbability(const SampleView& poses, std::span<float> logProbability) const {
  assert(poses.size() == logProbability.size());
  weigh(poses, logProbability);
}

double Weigher::logProbabilityAt(const Pose2& pose) const {
  const auto x = static_cast<float>(pose.x);
  const auto y = static_cast<float>(pose.y);
  const auto theta = static_cast<float>(pose.theta);
  float logProbability = 0.0F;
  weigh({{&x, 1}, {&y, 1}, {&theta, 1}}, {&logProbability, 1});
  return static_cast<double>(logProbability);
}

}  // namespace ortung
