#include "Drift.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "Resampling.hpp"
#include "ortung/base/FastMath.hpp"
#include "ortung/base/GaussianRows.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/base/Widest.hpp"

namespace ortung {
namespace {

constexpr std::size_t kBlock = 256;  ///< number of samples whose noise is drawn at once
/// Number of the first random number: far from those that a motion model takes from the same
/// stream.
constexpr std::uint64_t kFirstNumber = std::uint64_t{1} << 40;
constexpr std::size_t kNumbersASample = 4;  ///< x, y, theta, unused
/// Numbers of mean 0 and sigma 1: a row for each kind, a column for each sample.
using Noise = std::array<std::array<float, kBlock>, kNumbersASample>;

/// A motion and its noise, in single precision.
struct Step {
  float ahead;
  float left;
  float turn;
  float sigma;
  float sigmaTurn;
};

/// Moves @p n samples.
struct DriftAll {
  ORTUNG_INLINE static void run(Step step, const Noise* rows, std::size_t n, float* __restrict x,
                                float* __restrict y, float* __restrict theta) {
    const Noise& noise = *rows;
    for (std::size_t i = 0; i < n; ++i) {
      const SinCos heading = sinCos(theta[i]);
      x[i] += heading.cos * step.ahead - heading.sin * step.left + step.sigma * noise[0][i];
      y[i] += heading.sin * step.ahead + heading.cos * step.left + step.sigma * noise[1][i];
      theta[i] += step.turn + step.sigmaTurn * noise[2][i];
    }
  }
};

}  // namespace

double driftSeconds(Timestamp since, Timestamp until) {
  return std::max(0.0, toSeconds(until - since));
}

void drift(const MclConfig& config, const MovableSamples& samples, const Pose2& ahead,
           double seconds, std::uint64_t stream, std::uint64_t first) {
  const Step step{static_cast<float>(ahead.x), static_cast<float>(ahead.y),
                  static_cast<float>(ahead.theta),
                  static_cast<float>(config.driftMetres * std::sqrt(seconds)),
                  static_cast<float>(config.driftRadians * std::sqrt(seconds))};
  Noise noise;
  for (std::size_t begin = 0; begin < samples.x.size(); begin += kBlock) {
    const std::size_t count = std::min(kBlock, samples.x.size() - begin);
    const auto row = [&](std::size_t k) { return std::span(noise[k]).first(count); };
    fillGaussianRows(config.seed, stream, kFirstNumber / kNumbersASample + first + begin,
                     {row(0), row(1), row(2), row(3)});
    runWidest<DriftAll, Step, const Noise*>(step, &noise, count, samples.x.data() + begin,
                                            samples.y.data() + begin, samples.theta.data() + begin);
  }
}

Spread spread(const MclConfig& config, const SampleSet& moved, const SampleSet& anchor,
              const Pose2& ahead, double seconds, std::size_t n, std::uint64_t stream) {
  const std::size_t half = std::min(config.maxSamples, std::max(n, moved.size()));
  Random random(config.seed, stream);
  const double offset = random.uniform();
  const auto drawn = [&](const SampleSet& from) {
    return taken(from, lowVariance(normalized(from.logWeight), half, offset));
  };
  Spread both{drawn(moved), half};
  SampleSet near = drawn(anchor);
  drift(config, {near.x, near.y, near.theta}, ahead, seconds, stream, 0);
  add(both.samples, near, 0.5);
  return both;
}

}  // namespace ortung
