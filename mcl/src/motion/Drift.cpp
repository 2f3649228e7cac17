#include "Drift.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "Resampling.hpp"
#include "ortung/base/Random.hpp"

namespace ortung {
namespace {

constexpr std::size_t kBlock = 256;  ///< number of samples whose noise is drawn at once
/// Number of the first random number: far from those that a motion model takes from the same
/// stream.
constexpr std::uint64_t kFirstNumber = std::uint64_t{1} << 40;
/// Per sample: x, y, theta, unused (fillGaussian starts at even numbers).
constexpr std::size_t kNumbersASample = 4;

}  // namespace

double driftSeconds(Timestamp since, Timestamp until) {
  return std::max(0.0, toSeconds(until - since));
}

void drift(const MclConfig& config, const MovableSamples& samples, const Pose2& ahead,
           double seconds, std::uint64_t stream, std::uint64_t first) {
  const auto sigma = static_cast<float>(config.driftMetres * std::sqrt(seconds));
  const auto sigmaTurn = static_cast<float>(config.driftRadians * std::sqrt(seconds));
  const auto aheadX = static_cast<float>(ahead.x);
  const auto aheadY = static_cast<float>(ahead.y);
  const auto turn = static_cast<float>(ahead.theta);
  std::array<float, kBlock * kNumbersASample> noise;
  for (std::size_t begin = 0; begin < samples.x.size(); begin += kBlock) {
    const std::size_t count = std::min(kBlock, samples.x.size() - begin);
    fillGaussian(config.seed, stream, kFirstNumber + (first + begin) * kNumbersASample,
                 std::span(noise).first(count * kNumbersASample));
    for (std::size_t i = 0; i < count; ++i) {
      const float c = std::cos(samples.theta[begin + i]);
      const float s = std::sin(samples.theta[begin + i]);
      samples.x[begin + i] += c * aheadX - s * aheadY + sigma * noise[i * kNumbersASample];
      samples.y[begin + i] += s * aheadX + c * aheadY + sigma * noise[i * kNumbersASample + 1];
      samples.theta[begin + i] += turn + sigmaTurn * noise[i * kNumbersASample + 2];
    }
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
