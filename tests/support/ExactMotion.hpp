#pragma once

#include <cstddef>
#include <cstdint>

#include "ortung/motion/MotionModel.hpp"

namespace ortung::test {

/// Odometry without noise.
class ExactMotion : public MotionModel {
 public:
  void sampleMotion(const MovableSamples& samples, const Pose2& change, std::uint64_t,
                    std::uint64_t, std::uint64_t) const override {
    for (std::size_t i = 0; i < samples.x.size(); ++i) {
      const Pose2 there = Pose2{samples.x[i], samples.y[i], samples.theta[i]} * change;
      samples.x[i] = static_cast<float>(there.x);
      samples.y[i] = static_cast<float>(there.y);
      samples.theta[i] = static_cast<float>(there.theta);
    }
  }
};

}  // namespace ortung::test
