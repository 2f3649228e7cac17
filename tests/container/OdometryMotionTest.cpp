#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "ortung/motion/OdometryMotion.hpp"

namespace ortung {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr std::size_t kMany = 200000;

struct Cloud {
  std::vector<float> x;
  std::vector<float> y;
  std::vector<float> theta;
  Cloud(std::size_t n, const Pose2& pose)
      : x(n, static_cast<float>(pose.x)),
        y(n, static_cast<float>(pose.y)),
        theta(n, static_cast<float>(pose.theta)) {}
  MovableSamples part(std::size_t first, std::size_t count) {
    return {std::span(x).subspan(first, count), std::span(y).subspan(first, count),
            std::span(theta).subspan(first, count)};
  }
  MovableSamples all() { return part(0, x.size()); }
};

struct Moments {
  double mean = 0.0;
  double variance = 0.0;
};

Moments momentsOf(const std::vector<float>& values) {
  Moments m;
  const auto n = static_cast<double>(values.size());
  for (const float v : values) m.mean += static_cast<double>(v) / n;
  for (const float v : values)
    m.variance += (static_cast<double>(v) - m.mean) * (static_cast<double>(v) - m.mean) / n;
  return m;
}

void expectMoments(const std::vector<float>& values, double mean, double variance) {
  const Moments m = momentsOf(values);
  // Five standard errors of mean and variance; floats near 1 round to 1e-7.
  EXPECT_NEAR(m.mean, mean, 5 * std::sqrt(variance / kMany) + 1e-6);
  EXPECT_NEAR(m.variance, variance, 5 * variance * std::sqrt(2.0 / kMany) + 1e-9);
}

Cloud moved(const OdometryNoise& noise, const Pose2& start, const Pose2& change,
            std::uint64_t seed = 1) {
  Cloud cloud(kMany, start);
  OdometryMotion(noise).sampleMotion(cloud.all(), change, seed, 0, 0);
  return cloud;
}

const OdometryNoise kNone{0, 0, 0, 0, 0, 0};

TEST(OdometryMotion, WithoutNoiseIsTheComposition) {
  for (const Pose2& change :
       {Pose2{1, 0, 0}, Pose2{-0.5, 0, 0}, Pose2{0.3, 0.4, 1.0}, Pose2{-0.2, 0.1, -3.0},
        Pose2{0, 0, 2.5}, Pose2{0.0001, 0.0, 0.3}, Pose2{}}) {
    const Pose2 start{2, -1, 2.8};
    Cloud cloud(3, start);
    OdometryMotion(kNone).sampleMotion(cloud.all(), change, 1, 0, 0);
    const Pose2 expected = start * change;
    EXPECT_NEAR(cloud.x[2], expected.x, 2e-4);  // a way below a millimetre has no direction
    EXPECT_NEAR(cloud.y[2], expected.y, 2e-4);
    EXPECT_NEAR(wrapAngle(static_cast<double>(cloud.theta[2]) - expected.theta), 0.0, 1e-6);
  }
}

// Turn before the way N(0, s1^2), way N(d, sw^2), sideways N(0, f^2), turn after it:
// E x = d exp(-s1^2 / 2), E y^2 = (d^2 + sw^2) S + f^2 (1 - S), S = E sin^2 = (1 - exp(-2 s1^2))
// / 2.
TEST(OdometryMotion, SpreadsAStraightWayAsItsFormulaSays) {
  const OdometryNoise noise{.turnPerTurn = 0.2,
                            .turnPerMetre = 0.15,
                            .wayPerMetre = 0.1,
                            .wayPerTurn = 0.03,
                            .floorMetres = 0.01,
                            .floorRadians = 0.02};
  for (const double d : {0.25, 1.0, 2.0}) {
    const Cloud cloud = moved(noise, {}, {d, 0, 0});
    const double first = 0.5 * 0.15 * 0.15 * d;
    const double way = 0.1 * 0.1 * d + 0.01 * 0.01;
    const double s = (1 - std::exp(-2 * first)) / 2;
    const double meanX = d * std::exp(-first / 2);
    expectMoments(cloud.theta, 0.0, 2 * first + 0.02 * 0.02);
    expectMoments(cloud.y, 0.0, (d * d + way) * s + 0.01 * 0.01 * (1 - s));
    const Moments x = momentsOf(cloud.x);
    const double varianceX = (d * d + way) * (1 - s) + 0.01 * 0.01 * s - meanX * meanX;
    EXPECT_NEAR(x.mean, meanX, 5 * std::sqrt(varianceX / kMany) + 1e-6);
    EXPECT_NEAR(x.variance, varianceX, 0.03 * varianceX);
  }
}

TEST(OdometryMotion, SpreadsATurnOnTheSpot) {
  const OdometryNoise noise{.turnPerTurn = 0.2,
                            .turnPerMetre = 0,
                            .wayPerMetre = 0,
                            .wayPerTurn = 0.05,
                            .floorMetres = 0.0,
                            .floorRadians = 0.0};
  const double turn = 1.5;
  const Cloud cloud = moved(noise, {}, {0, 0, turn});
  expectMoments(cloud.theta, turn, 0.2 * 0.2 * turn);
  expectMoments(cloud.x, 0.0, 0.05 * 0.05 * turn);  // the way is taken before the second turn
}

TEST(OdometryMotion, StandingStillHasTheFloorOnly) {
  const OdometryNoise noise{.floorMetres = 0.02, .floorRadians = 0.03};
  const Cloud cloud = moved(noise, {1, 2, 0.7}, {});
  expectMoments(cloud.x, 1.0, 4e-4);
  expectMoments(cloud.y, 2.0, 4e-4);
  expectMoments(cloud.theta, static_cast<double>(0.7F), 9e-4);
}

// A robot that drives backwards does not turn round, drive and turn back.
TEST(OdometryMotion, DrivingBackwardsSpreadsLikeDrivingForwards) {
  const OdometryNoise noise;
  const Cloud forwards = moved(noise, {}, {0.8, 0.1, 0.2});
  const Cloud backwards = moved(noise, {}, inverse(Pose2{0.8, 0.1, 0.2}), 2);
  EXPECT_NEAR(momentsOf(backwards.theta).variance, momentsOf(forwards.theta).variance,
              0.02 * momentsOf(forwards.theta).variance);
  EXPECT_NEAR(momentsOf(backwards.theta).mean, -0.2, 1e-3);
  const Cloud straight = moved(noise, {}, {-1, 0, 0});
  expectMoments(straight.theta, 0.0, 0.1 * 0.1 + 0.002 * 0.002);
  EXPECT_NEAR(momentsOf(straight.x).mean, -1.0, 0.01);
}

TEST(OdometryMotion, AWayInPiecesSpreadsLikeTheWhole) {
  const OdometryNoise noise{.floorMetres = 0, .floorRadians = 0};
  const Cloud whole = moved(noise, {}, {1, 0, 0});
  Cloud pieces(kMany, {});
  for (std::uint64_t step = 0; step < 20; ++step)
    OdometryMotion(noise).sampleMotion(pieces.all(), {0.05, 0, 0}, 3, step, 0);
  EXPECT_NEAR(momentsOf(pieces.theta).variance, momentsOf(whole.theta).variance,
              0.03 * momentsOf(whole.theta).variance);
  EXPECT_NEAR(momentsOf(pieces.x).variance, momentsOf(whole.x).variance,
              0.05 * momentsOf(whole.x).variance);
}

TEST(OdometryMotion, DependsOnSeedStreamAndPlaceAlone) {
  const OdometryMotion motion;
  const Pose2 change{0.3, 0.02, 0.1};
  Cloud whole(5000, {1, 1, 1});
  motion.sampleMotion(whole.all(), change, 4, 5, 0);
  Cloud cut(5000, {1, 1, 1});
  for (std::size_t first = 0; first < 5000;) {
    const std::size_t count = std::min<std::size_t>(5000 - first, 2 * (first % 7) + 333);
    motion.sampleMotion(cut.part(first, count), change, 4, 5, first);
    first += count;
  }
  EXPECT_EQ(whole.x, cut.x);
  EXPECT_EQ(whole.y, cut.y);
  EXPECT_EQ(whole.theta, cut.theta);
  Cloud other(5000, {1, 1, 1});
  motion.sampleMotion(other.all(), change, 4, 6, 0);
  EXPECT_NE(whole.x, other.x);
}

TEST(OdometryCorrection, HasTheLimitsThatRefusalsTell) {
  struct Limits {
    const char* key;
    double low;
    double high;
  };
  for (const auto& [key, low, high] : {Limits{"way_scale", 0.5, 2.0},
                                       {"turn_scale", 0.5, 2.0},
                                       {"turn_bias_deg_per_m", -180.0, 180.0},
                                       {"way_bias_m_per_rad", -10.0, 10.0},
                                       {"delay_s", -0.3, 2.0}}) {
    const auto read = [&, key = key](double number) {
      Parameters p("r.toml");
      p.set(key, number);
      return OdometryCorrection::read(p);
    };
    EXPECT_NO_THROW(read(low)) << key;
    EXPECT_NO_THROW(read(high)) << key;
    EXPECT_THROW(read(low - 1e-6), ConfigError) << key;
    EXPECT_THROW(read(high + 1e-6), ConfigError) << key;
  }
}

TEST(OdometryNoise, IsChecked) {
  for (const double bad : {-0.1, 101.0, static_cast<double>(NAN), static_cast<double>(INFINITY)}) {
    OdometryNoise noise;
    noise.wayPerTurn = bad;
    EXPECT_THROW(noise.check(), std::invalid_argument);
    EXPECT_THROW(OdometryMotion{noise}, std::invalid_argument);
  }
  Parameters p("r.toml");
  p.set("way_per_m", -1.0);
  EXPECT_THROW(OdometryNoise::read(p), ConfigError);
  Parameters misspelt("r.toml");
  misspelt.set("way_per_metre", 1.0);
  EXPECT_THROW(OdometryNoise::read(misspelt), ConfigError);
  Parameters good;
  good.set("floor_deg", 90.0);
  EXPECT_NEAR(OdometryNoise::read(good).floorRadians, kPi / 2, 1e-12);
}

}  // namespace
}  // namespace ortung
