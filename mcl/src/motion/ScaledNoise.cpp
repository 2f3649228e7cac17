#include "ScaledNoise.hpp"

#include <cmath>
#include <vector>

#include "MotionTuning.hpp"

namespace ortung {
namespace {

/// Samples that were moved without noise.
struct Moved {
  explicit Moved(std::size_t n) : x(n), y(n), theta(n) {}
  std::vector<float> x, y, theta;
};

Moved movedBy(const Pose2& change, const MovableSamples& samples) {
  Moved moved(samples.x.size());
  const auto ahead = static_cast<float>(change.x);
  const auto left = static_cast<float>(change.y);
  const auto turn = static_cast<float>(change.theta);
  for (std::size_t i = 0; i < samples.x.size(); ++i) {
    const float c = std::cos(samples.theta[i]);
    const float s = std::sin(samples.theta[i]);
    moved.x[i] = samples.x[i] + c * ahead - s * left;
    moved.y[i] = samples.y[i] + s * ahead + c * left;
    moved.theta[i] = samples.theta[i] + turn;
  }
  return moved;
}

}  // namespace

void sampleMotion(const MotionModel& motion, const MovableSamples& samples, const Pose2& change,
                  const Pose2& mean, double noise, std::uint64_t seed, std::uint64_t stream,
                  std::uint64_t first) {
  if (noise == 1.0) return motion.sampleMotion(samples, change, seed, stream, first);
  const Moved without = movedBy(mean, samples);
  motion.sampleMotion(samples, change, seed, stream, first);
  const auto scale = static_cast<float>(std::sqrt(noise));
  for (std::size_t i = 0; i < samples.x.size(); ++i) {
    if (noise < 1.0 && (first + i) % tuning::odometry::kOfAllNoise == 0) continue;
    const float turn = static_cast<float>(
        wrapAngle(static_cast<double>(samples.theta[i]) - static_cast<double>(without.theta[i])));
    samples.x[i] = without.x[i] + scale * (samples.x[i] - without.x[i]);
    samples.y[i] = without.y[i] + scale * (samples.y[i] - without.y[i]);
    samples.theta[i] = without.theta[i] + scale * turn;
  }
}

}  // namespace ortung
