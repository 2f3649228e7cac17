#include "ortung/pictures/Variation.hpp"

#include <algorithm>
#include <cmath>

#include "ortung/base/Angles.hpp"
#include "ortung/base/Random.hpp"

namespace ortung {
namespace {

// Random streams of the seed.
constexpr std::uint64_t kLight = 1;
constexpr std::uint64_t kEffects = 2;

/// Draws numbers around usual ones; the stronger the variation, the farther they are from them.
class Dice {
 public:
  Dice(const Variation& variation, std::uint64_t stream)
      : strength_(std::clamp(variation.strength, 0.0, 1.0)), random_(variation.seed, stream) {}
  /// Returns a number in [low, high] at full strength; @p usual at strength 0.
  float around(double usual, double low, double high) {
    const double drawn = random_.uniform(low, high);
    return static_cast<float>(usual + strength_ * (drawn - usual));
  }
  /// Returns a number in [0, most].
  float upTo(double most) { return around(0.0, 0.0, most); }
  /// Returns a factor in [e^-most, e^most].
  float factor(double most) {
    return static_cast<float>(std::exp(strength_ * random_.uniform(-most, most)));
  }
  std::uint32_t word() { return random_.next(); }
  bool isStrong() const { return strength_ > 0.0; }

 private:
  double strength_;
  Random random_;
};

}  // namespace

Lighting lightingOf(const Variation& variation) {
  Lighting light;
  Dice dice(variation, kLight);
  if (!dice.isStrong()) return light;
  light.ambient = dice.around(light.ambient, 0.4, 0.85);
  const double turn = dice.around(0.6, 0.0, kTurn);
  const double rise = dice.around(1.2, 0.6, 1.5);
  light.towardsLight = {static_cast<float>(std::cos(rise) * std::cos(turn)),
                        static_cast<float>(std::cos(rise) * std::sin(turn)),
                        static_cast<float>(std::sin(rise))};
  for (float& part : light.turf) part *= dice.factor(0.3);
  const float grey = dice.factor(0.5);
  for (float& part : light.ground) part *= grey * dice.factor(0.08);
  const float bright = dice.factor(0.8);
  for (float& part : light.background) part = std::min(part * bright * dice.factor(0.1), 1.0F);
  light.grain = dice.upTo(0.45);
  light.patches = dice.upTo(0.2);
  light.stripes = dice.around(0.0, -0.06, 0.1);
  light.stripes = std::max(light.stripes, 0.0F);
  light.stripeWidth = dice.around(1.5, 0.8, 2.5);
  light.stripeAngle = dice.word() % 2 == 0 ? 0.0F : 0.25F * kTurnFloat;
  light.seed = dice.word();
  return light;
}

SensorEffects effectsOf(const Variation& variation) {
  SensorEffects effects;
  Dice dice(variation, kEffects);
  if (!dice.isStrong()) return effects;
  effects.blur = dice.upTo(0.2);
  const float exposure = dice.factor(0.35);
  effects.gains = {exposure * dice.factor(0.15), exposure, exposure * dice.factor(0.2)};
  effects.vignetting = dice.upTo(0.45);
  effects.noise = dice.around(0.0, 0.5, 5.0);
  effects.shotNoise = dice.upTo(4.0);
  return effects;
}

}  // namespace ortung
