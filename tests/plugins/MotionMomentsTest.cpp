// Moments that motion models know in closed form, against those of many samples.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "NeuralRig.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/motion/MotionMoments.hpp"
#include "ortung/motion/OdometryMotion.hpp"

namespace ortung {
namespace {

constexpr std::size_t kMany = 300'000;

/// How far samples are off the mean that a model tells, and the products of that, each with its
/// standard error.
struct Off {
  std::array<double, 3> mean{};
  std::array<double, 3> meanError{};
  std::array<double, 9> product{};
  std::array<double, 9> productError{};
};

Off offOf(const MotionModel& motion, const Pose2& change, const Pose2& mean, std::uint64_t seed) {
  std::array<std::vector<float>, 3> drawn;
  for (std::vector<float>& axis : drawn) axis.assign(kMany, 0.0F);
  motion.sampleMotion({drawn[0], drawn[1], drawn[2]}, change, seed, 7, 0);
  Off off;
  std::array<double, 9> squares{};
  constexpr auto kN = static_cast<double>(kMany);
  // Moments are those of headings that don't wrap; all of them may be off by a whole turn.
  constexpr double kTurn = 2.0 * std::numbers::pi;
  const double heading = std::accumulate(drawn[2].begin(), drawn[2].end(), 0.0) / kN;
  const double turns = kTurn * std::round((heading - mean.theta) / kTurn);
  for (std::size_t i = 0; i < kMany; ++i) {
    const auto at = [&](std::size_t axis) { return static_cast<double>(drawn[axis][i]); };
    const std::array<double, 3> d = {at(0) - mean.x, at(1) - mean.y, at(2) - mean.theta - turns};
    for (std::size_t row = 0; row < 3; ++row) {
      off.mean[row] += d[row] / kN;
      for (std::size_t column = 0; column < 3; ++column) {
        const double product = d[row] * d[column];
        off.product[3 * row + column] += product / kN;
        squares[3 * row + column] += product * product / kN;
      }
    }
  }
  for (std::size_t k = 0; k < 3; ++k) off.meanError[k] = std::sqrt(off.product[4 * k] / kN);
  for (std::size_t k = 0; k < 9; ++k)
    off.productError[k] = std::sqrt((squares[k] - off.product[k] * off.product[k]) / kN);
  return off;
}

/// Settings of noise and correction, drawn; each may be 0.
std::string drawnSettings(Random& random) {
  const auto some = [&](double most) {
    return random.uniform() < 0.2 ? 0.0 : most * random.uniform();
  };
  std::ostringstream toml;
  toml << "turn_per_turn = " << some(0.1) << "\nturn_per_m = " << some(0.2)
       << "\nway_per_m = " << some(0.2) << "\nway_per_turn = " << some(0.1)
       << "\nfloor_m = " << some(0.05) << "\nfloor_deg = " << some(1.0)
       << "\nslip_share = " << some(0.3) << "\nway_scale = " << 0.8 + 0.4 * random.uniform()
       << "\nturn_scale = " << 0.8 + 0.4 * random.uniform()
       << "\nturn_bias_deg_per_m = " << some(10.0) << "\nway_bias_m_per_rad = " << some(0.1)
       << '\n';
  return toml.str();
}

using Moments = NeuralRig;

TEST_F(Moments, AreThoseOfSamplesForEachPlugin) {
  Random random(31);
  for (const char* plugin : {"odometry", "differential", "omni", "neural"}) {
    for (int round = 0; round < 8; ++round) {
      std::string toml = drawnSettings(random);
      if (plugin == std::string("neural")) toml += settings(obedientNetwork(false));
      const Pose2 change{random.uniform() - 0.5, 0.6 * (random.uniform() - 0.5),
                         1.2 * (random.uniform() - 0.5)};
      SCOPED_TRACE(std::string(plugin) + "\n" + toml + "change " + std::to_string(change.x) + " " +
                   std::to_string(change.y) + " " + std::to_string(change.theta));
      const auto motion = makeMotion(plugin, toml);
      const std::optional<MotionChange> its = momentsOf(*motion, change);
      ASSERT_TRUE(its.has_value());
      const Off off = offOf(*motion, change, its->mean, static_cast<std::uint64_t>(round));
      // 96 means and 192 products are compared; floats are off by some 1e-8.
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_NEAR(off.mean[k], 0.0, 5 * off.meanError[k] + 1e-7);
      for (std::size_t k = 0; k < 9; ++k)
        EXPECT_NEAR(off.product[k], its->covariance[k], 5 * off.productError[k] + 1e-8) << k;
      for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t column = 0; column < row; ++column)
          EXPECT_EQ(its->covariance[3 * row + column], its->covariance[3 * column + row]);
    }
  }
}

// Sums of half a metre have variances of 1e-16 left by rounding, never negative ones.
TEST_F(Moments, WithoutNoiseAreTheChangeAlone) {
  const OdometryMotion motion(OdometryNoise{0, 0, 0, 0, 0, 0});
  for (const Pose2& change :
       {Pose2{0.5, 0.2, 0.3}, Pose2{-0.5, 0.1, -1.0}, Pose2{0, 0, 3.0}, Pose2{0.2, 0, 0}}) {
    const std::optional<MotionChange> its = momentsOf(motion, change);
    ASSERT_TRUE(its.has_value());
    EXPECT_NEAR(its->mean.x, change.x, 1e-12);
    EXPECT_NEAR(its->mean.y, change.y, 1e-12);
    EXPECT_NEAR(its->mean.theta, change.theta, 1e-12);
    for (const std::size_t k : {0u, 4u, 8u}) EXPECT_GE(its->covariance[k], 0.0);
    for (const double value : its->covariance) EXPECT_NEAR(value, 0.0, 1e-15);
  }
}

TEST_F(Moments, AreNotToldWhereTurnsMayWrap) {
  const OdometryMotion motion(OdometryNoise{0, 0.1, 0, 0, 0, 0});  // sigma is 0.1 sqrt(m) rad
  EXPECT_TRUE(momentsOf(motion, {24.9, 0, 0}).has_value());
  EXPECT_FALSE(momentsOf(motion, {25.1, 0, 0}).has_value());
}

/// Moves samples in another way than the class that it derives from.
class Sideways : public OdometryMotion {
 public:
  void sampleMotion(const MovableSamples& samples, const Pose2&, std::uint64_t, std::uint64_t,
                    std::uint64_t) const override {
    for (float& y : samples.y) y += 1.0F;
  }
};

TEST_F(Moments, AreNotInheritedByAClassThatMovesSamplesInAnotherWay) {
  EXPECT_TRUE(momentsOf(OdometryMotion(), {0.1, 0, 0}).has_value());
  EXPECT_FALSE(momentsOf(Sideways(), {0.1, 0, 0}).has_value());
}

}  // namespace
}  // namespace ortung
