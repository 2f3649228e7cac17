#pragma once

#include <span>

#include "ortung/base/Pose2.hpp"
#include "ortung/base/SampleView.hpp"

namespace ortung {

/// ln p at one pose of what weighs whole sets: @p weigh(const SampleView&, std::span<float>) adds
/// to the second. So a format's single and batched answers are the same.
template <class Weigh>
double weighOne(const Pose2& pose, const Weigh& weigh) {
  const auto x = static_cast<float>(pose.x);
  const auto y = static_cast<float>(pose.y);
  const auto theta = static_cast<float>(pose.theta);
  float logProbability = 0.0F;
  weigh(SampleView{{&x, 1}, {&y, 1}, {&theta, 1}}, std::span<float>(&logProbability, 1));
  return static_cast<double>(logProbability);
}

}  // namespace ortung
