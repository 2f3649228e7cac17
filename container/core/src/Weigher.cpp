#include "ortung/core/Weigher.hpp"

#include <cassert>
#include <cmath>

#include "ortung/base/OneSample.hpp"

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
  return weighOne(pose, [this](const SampleView& one, std::span<float> out) { weigh(one, out); });
}

}  // namespace ortung
