#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>

#include "ortung/base/Angles.hpp"
#include "ortung/base/FastMath.hpp"
#include "ortung/base/PoseCovariance.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/core/Plugin.hpp"
#include "ortung/motion/MotionMoments.hpp"
#include "ortung/motion/OdometryMotion.hpp"

namespace ortung {
namespace {

constexpr std::size_t kBlock = 256;  ///< number of samples whose noise is drawn at once
/// Numbers per sample: x, y, theta, unused (fillGaussian works on pairs).
constexpr std::size_t kNumbersASample = 4;

double square(double value) { return value * value; }

/// The motion model of a robot that moves in any direction: noise does not depend on its heading.
/// Variances are proportional to distance and turn, so readings may come at any rate.
class OmniMotion final : public OdometryMotion, public MotionMoments {
 public:
  using OdometryMotion::OdometryMotion;

  void sampleMotion(const MovableSamples& samples, const Pose2& odometryChange, std::uint64_t seed,
                    std::uint64_t stream, std::uint64_t first) const override {
    const Pose2 change = correction().apply(odometryChange);
    const Sigmas sigmas = sigmasOf(change);
    const auto sigmaWay = static_cast<float>(sigmas.way);
    const auto sigmaTurn = static_cast<float>(sigmas.turn);
    const auto x = static_cast<float>(change.x);
    const auto y = static_cast<float>(change.y);
    const auto theta = static_cast<float>(change.theta);
    std::array<float, kBlock * kNumbersASample> noise;
    for (std::size_t begin = 0; begin < samples.x.size(); begin += kBlock) {
      const std::size_t count = std::min(kBlock, samples.x.size() - begin);
      fillGaussian(seed, stream, (first + begin) * kNumbersASample,
                   std::span(noise).first(count * kNumbersASample));
      this->noise().forEachSlip(first + begin, count, [&](std::size_t i) {
        for (float& number : std::span(noise).subspan(i * kNumbersASample, kNumbersASample))
          number *= OdometryNoise::kSlip;
      });
      for (std::size_t i = 0; i < count; ++i) {
        const float* numbers = noise.data() + i * kNumbersASample;
        const float along = x + sigmaWay * numbers[0];
        const float across = y + sigmaWay * numbers[1];
        const SinCos heading = sinCos(samples.theta[begin + i]);
        samples.x[begin + i] += along * heading.cos - across * heading.sin;
        samples.y[begin + i] += along * heading.sin + across * heading.cos;
        samples.theta[begin + i] += theta + sigmaTurn * numbers[2];
      }
    }
  }

  std::optional<MotionChange> moments(const Pose2& odometryChange) const override {
    const Pose2 change = correction().apply(odometryChange);
    const Sigmas sigmas = sigmasOf(change);
    const double more =
        1.0 + noise().slips() * (square(static_cast<double>(OdometryNoise::kSlip)) - 1.0);
    const double way = more * square(sigmas.way);
    return MotionChange{{change.x, change.y, wrapAngle(change.theta)},
                        independent(way, way, more * square(sigmas.turn))};
  }

 private:
  struct Sigmas {
    double way;
    double turn;
  };

  Sigmas sigmasOf(const Pose2& change) const {
    const double way = std::hypot(change.x, change.y);
    const double turn = std::abs(change.theta);
    return {std::sqrt(square(noise().wayPerMetre) * way + square(noise().wayPerTurn) * turn +
                      square(noise().floorMetres)),
            std::sqrt(square(noise().turnPerMetre) * way + square(noise().turnPerTurn) * turn +
                      square(noise().floorRadians))};
  }
};

}  // namespace
}  // namespace ortung

ORTUNG_PLUGINS("omni_motion", ortung::provide<ortung::MotionModel, ortung::OmniMotion>("omni"));
