#include "ScaledNoise.hpp"

#include <cmath>
#include <vector>

#include "MotionTuning.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/base/FastMath.hpp"
#include "ortung/base/Widest.hpp"

namespace ortung {
namespace {

/// Samples of their own.
struct Samples {
  explicit Samples(std::size_t n) : x(n), y(n), theta(n) {}
  std::vector<float> x, y, theta;
};

/// Moves @p n samples without noise.
struct MoveBy {
  ORTUNG_INLINE static void run(float ahead, float left, float turn, std::size_t n, const float* x,
                                const float* y, const float* theta, float* __restrict toX,
                                float* __restrict toY, float* __restrict toTheta) {
    for (std::size_t i = 0; i < n; ++i) {
      const SinCos heading = sinCos(theta[i]);
      toX[i] = x[i] + heading.cos * ahead - heading.sin * left;
      toY[i] = y[i] + heading.sin * ahead + heading.cos * left;
      toTheta[i] = theta[i] + turn;
    }
  }
};

/// Returns the angle that is nearest to 0 and differs by whole turns; one that is very large or no
/// number stays as it is. Without a call, so that loops vectorize.
ORTUNG_INLINE float nearestToZero(float angle) {
  constexpr float kMost = 1e5F;
  const float turns = angle * (1.0F / kTurnFloat);
  const bool usual =
      static_cast<bool>(static_cast<int>(turns > -kMost) & static_cast<int>(turns < kMost));
  const float bounded = usual ? turns : 0.0F;
  const int whole = static_cast<int>(bounded + (bounded < 0.0F ? -0.5F : 0.5F));
  return angle - static_cast<float>(whole) * kTurnFloat;
}

/// Scales the way from where samples would be without noise.
struct ScaleFrom {
  ORTUNG_INLINE static void run(float scale, std::size_t n, const float* fromX, const float* fromY,
                                const float* fromTheta, float* __restrict x, float* __restrict y,
                                float* __restrict theta) {
    for (std::size_t i = 0; i < n; ++i) {
      x[i] = fromX[i] + scale * (x[i] - fromX[i]);
      y[i] = fromY[i] + scale * (y[i] - fromY[i]);
      theta[i] = fromTheta[i] + scale * nearestToZero(theta[i] - fromTheta[i]);
    }
  }
};

}  // namespace

void sampleMotion(const MotionModel& motion, const MovableSamples& samples, const Pose2& change,
                  const Pose2& mean, double noise, std::uint64_t seed, std::uint64_t stream,
                  std::uint64_t first) {
  if (noise == 1.0) return motion.sampleMotion(samples, change, seed, stream, first);
  const std::size_t n = samples.x.size();
  Samples without(n);
  runWidest<MoveBy>(static_cast<float>(mean.x), static_cast<float>(mean.y),
                    static_cast<float>(mean.theta), n, samples.x.data(), samples.y.data(),
                    samples.theta.data(), without.x.data(), without.y.data(), without.theta.data());
  motion.sampleMotion(samples, change, seed, stream, first);
  if (noise < 1.0) {  // these keep all of it, as if they had been there without it
    const std::uint64_t kEach = tuning::odometry::kOfAllNoise;
    for (std::size_t i = (kEach - first % kEach) % kEach; i < n; i += kEach) {
      without.x[i] = samples.x[i];
      without.y[i] = samples.y[i];
      without.theta[i] = samples.theta[i];
    }
  }
  runWidest<ScaleFrom>(static_cast<float>(std::sqrt(noise)), n, without.x.data(), without.y.data(),
                       without.theta.data(), samples.x.data(), samples.y.data(),
                       samples.theta.data());
}

}  // namespace ortung
