#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "ortung/container/MotionModel.hpp"
#include "ortung/container/Parameters.hpp"
#include "ortung/container/Plugin.hpp"
#include "ortung/container/Random.hpp"
#include "ortung/container/SinCos.hpp"

namespace ortung {
namespace {

constexpr std::size_t kBlock = 256;         ///< samples whose noise is drawn at once
constexpr std::size_t kNumbersASample = 4;  ///< x, y, theta, none (fillGaussian starts evenly)
constexpr double kDegree = std::numbers::pi / 180.0;

double square(double value) { return value * value; }

/// [motion] of a robot that moves in any direction. Variances grow with way and turn, so readings
/// may come at any rate.
struct OmniNoise {
  double wayPerMetre = 0.1;     ///< `way_per_m`: in every direction, after 1 m [m]
  double wayPerTurn = 0.03;     ///< `way_per_turn`: in every direction, after turning 1 rad [m]
  double turnPerMetre = 0.1;    ///< `turn_per_m`: after 1 m [rad]
  double turnPerTurn = 0.2;     ///< `turn_per_turn`: after turning 1 rad [rad]
  double floorMetres = 0.003;   ///< `floor_m`: of every step [m]
  double floorRadians = 0.002;  ///< `floor_deg`: of every step [rad]

  static OmniNoise read(const Parameters& p) {
    OmniNoise n;
    const Range range{0.0, 100.0};
    p.textOr("plugin", "");
    n.turnPerTurn = p.numberOr("turn_per_turn", n.turnPerTurn, range);
    n.turnPerMetre = p.numberOr("turn_per_m", n.turnPerMetre, range);
    n.wayPerMetre = p.numberOr("way_per_m", n.wayPerMetre, range);
    n.wayPerTurn = p.numberOr("way_per_turn", n.wayPerTurn, range);
    n.floorMetres = p.numberOr("floor_m", n.floorMetres, range);
    n.floorRadians = kDegree * p.numberOr("floor_deg", n.floorRadians / kDegree, range);
    return n;
  }
};

/// A robot that moves in any direction: noise does not know where its front is.
class OmniMotion : public MotionModel {
 public:
  explicit OmniMotion(const Parameters& motion) : noise_(OmniNoise::read(motion)) {}

  void sampleMotion(const MovableSamples& samples, const Pose2& change, std::uint64_t seed,
                    std::uint64_t stream, std::uint64_t first) const override {
    const double way = std::hypot(change.x, change.y);
    const double turn = std::abs(change.theta);
    const auto sigmaWay = static_cast<float>(std::sqrt(square(noise_.wayPerMetre) * way +
                                                       square(noise_.wayPerTurn) * turn +
                                                       square(noise_.floorMetres)));
    const auto sigmaTurn = static_cast<float>(std::sqrt(square(noise_.turnPerMetre) * way +
                                                        square(noise_.turnPerTurn) * turn +
                                                        square(noise_.floorRadians)));
    const auto x = static_cast<float>(change.x);
    const auto y = static_cast<float>(change.y);
    const auto theta = static_cast<float>(change.theta);
    std::array<float, kBlock * kNumbersASample> noise;
    for (std::size_t begin = 0; begin < samples.x.size(); begin += kBlock) {
      const std::size_t count = std::min(kBlock, samples.x.size() - begin);
      fillGaussian(seed, stream, (first + begin) * kNumbersASample,
                   std::span(noise).first(count * kNumbersASample));
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

 private:
  OmniNoise noise_;
};

}  // namespace
}  // namespace ortung

ORTUNG_PLUGINS("omni_motion", ortung::provide<ortung::MotionModel, ortung::OmniMotion>("omni"));
