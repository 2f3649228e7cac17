// What a scan says of a small change of the pose, in a room of which all is known.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/LU>
#include <cmath>
#include <memory>

#include "FakeRoom.hpp"
#include "ortung/core/Polishable.hpp"

namespace ortung {
namespace {

using test::kPi;
using Perception = ScanData::Perception;

const test::Room kRoom;
const Pose2 kMount{0.1, -0.05, 0.3};

ScanData::Config config(Perception perception) {
  ScanData::Config c{.beams = 181, .firstAngle = -kPi / 2, .angleStep = kPi / 180, .maxRange = 9.0};
  c.perception = perception;
  c.model = {.sigma = 0.02, .sigmaPerMetre = 0.0, .outliers = 0.05, .exponent = 0.06};
  return c;
}

ScanData& learned(Perception perception) {
  static const auto make = [](Perception p) {
    auto data = std::make_unique<ScanData>(SensorId{"M", "T", "F"}, kMount, config(p));
    test::learnEverywhere(*data, kRoom.region(0.1, 0.2), kPi / 90,
                          [&](const Pose2& s) { return scanWords(kRoom, s, config(p)); });
    return data;
  };
  static const auto rays = make(Perception::kRays);
  static const auto ends = make(Perception::kEndPoints);
  return perception == Perception::kRays ? *rays : *ends;
}

/// A reading with noise at @p truth.
std::shared_ptr<const Weigher> readAt(ScanData& data, const Pose2& truth, double noise,
                                      std::uint64_t seed) {
  const ScanData::Config& c = data.config();
  const Pose2 sensor = truth * kMount;
  Random random(seed);
  std::vector<float> ranges;
  for (int i = 0; i < c.beams; ++i)
    ranges.push_back(static_cast<float>(
        kRoom.range(sensor.x, sensor.y, sensor.theta + c.firstAngle + i * c.angleStep) +
        noise * random.gaussian()));
  std::vector<std::uint32_t> words;
  ScanData::encode(ranges, c.maxRange, words);
  data.setData(static_cast<Timestamp>(seed), words);
  return data.weigher();
}

/// The inverse of the Cramér-Rao bound of a scan (Censi 2007), by differences of the room's ranges.
Eigen::Matrix3d fisher(const Pose2& truth, double noise) {
  const ScanData::Config c = config(Perception::kRays);
  const auto rangeAt = [&](const Pose2& robot, int beam) {
    const Pose2 sensor = robot * kMount;
    return kRoom.range(sensor.x, sensor.y, sensor.theta + c.firstAngle + beam * c.angleStep);
  };
  constexpr double kStep = 1e-6;
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  for (int beam = 0; beam < c.beams; ++beam) {
    const auto by = [&](double dx, double dy, double dt) {
      return (rangeAt({truth.x + dx, truth.y + dy, truth.theta + dt}, beam) -
              rangeAt({truth.x - dx, truth.y - dy, truth.theta - dt}, beam)) /
             (2 * kStep);
    };
    const Eigen::Vector3d g(by(kStep, 0, 0), by(0, kStep, 0), by(0, 0, kStep));
    if (g.norm() < 50.0) information += g * g.transpose() / (noise * noise);  // not over a corner
  }
  return information;
}

/// Where Newton's steps end from @p from on, without prior.
Pose2 descended(const Polishable& reading, Pose2 from) {
  for (int i = 0; i < 20; ++i) {
    const Slope slope = reading.slopeAt(from);
    const Eigen::Vector3d d = Eigen::Map<const Eigen::Matrix3d>(slope.information.data())
                                  .ldlt()
                                  .solve(Eigen::Map<const Eigen::Vector3d>(slope.pull.data()));
    from = {from.x + d.x(), from.y + d.y(), wrapAngle(from.theta + d.z())};
  }
  return from;
}

class ScanSlope : public testing::TestWithParam<Perception> {};

TEST_P(ScanSlope, LeadsToThePoseOfAReading) {
  Random random(5);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Pose2 truth{random.uniform(-3, 3), random.uniform(-1.8, 1.8), random.uniform(-kPi, kPi)};
    const auto weigher = readAt(learned(GetParam()), truth, 0.0, seed);
    const auto* reading = dynamic_cast<const Polishable*>(weigher.get());
    ASSERT_NE(reading, nullptr);
    const Pose2 found = descended(
        *reading, {truth.x + random.uniform(-0.06, 0.06), truth.y + random.uniform(-0.06, 0.06),
                   truth.theta + random.uniform(-0.03, 0.03)});
    EXPECT_LT(std::hypot(found.x - truth.x, found.y - truth.y), 0.002) << seed;
    EXPECT_LT(std::abs(wrapAngle(found.theta - truth.theta)), 0.0005) << seed;
  }
}

TEST_P(ScanSlope, KnowsAsMuchAsTheRangesDo) {
  // With the noise that the model has; ends are compared with lines, grazing ones count less.
  Random random(7);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Pose2 truth{random.uniform(-3, 3), random.uniform(-1.8, 1.8), random.uniform(-kPi, kPi)};
    const auto weigher = readAt(learned(GetParam()), truth, 0.02, seed);
    const Slope slope = dynamic_cast<const Polishable&>(*weigher).slopeAt(truth);
    const Eigen::Matrix3d ours =
        Eigen::Map<const Eigen::Matrix3d>(slope.information.data()).inverse();
    const Eigen::Matrix3d bound = fisher(truth, 0.02).inverse();
    for (int k = 0; k < 3; ++k) {
      EXPECT_GT(ours(k, k), 0.6 * bound(k, k)) << seed << " " << k;
      EXPECT_LT(ours(k, k), 2.5 * bound(k, k)) << seed << " " << k;
    }
  }
}

TEST_P(ScanSlope, ErrsAsItSays) {
  // 200 noisy scans at one pose: normalized error 3 in the mean, whatever noise the model expects.
  for (const double noise : {0.008, 0.02}) {
    const Pose2 truth{1.2, -0.7, 0.8};
    double squares = 0.0;
    constexpr int kRuns = 200;
    for (std::uint64_t seed = 1; seed <= kRuns; ++seed) {
      const auto weigher = readAt(learned(GetParam()), truth, noise, seed);
      const auto& reading = dynamic_cast<const Polishable&>(*weigher);
      const Pose2 found = descended(reading, truth);
      const Slope slope = reading.slopeAt(found);
      const Eigen::Vector3d off(found.x - truth.x, found.y - truth.y,
                                wrapAngle(found.theta - truth.theta));
      squares += off.dot(Eigen::Map<const Eigen::Matrix3d>(slope.information.data()) * off);
    }
    EXPECT_GT(squares / kRuns, 1.5) << noise;
    EXPECT_LT(squares / kRuns, 5.0) << noise;
  }
}

TEST_P(ScanSlope, HeedsNoOutliers) {
  const Pose2 truth{-1.0, 0.4, 2.0};
  ScanData& data = learned(GetParam());
  readAt(data, truth, 0.01, 1);
  std::vector<std::uint32_t> words(data.getData().begin(), data.getData().end());
  for (std::size_t i = 0; i < words.size(); i += 3) words[i] = words[i] / 2;  // somebody is there
  data.setData(2, words);
  const auto weigher = data.weigher();
  const Pose2 found = descended(dynamic_cast<const Polishable&>(*weigher),
                                {truth.x + 0.04, truth.y - 0.03, truth.theta + 0.02});
  EXPECT_LT(std::hypot(found.x - truth.x, found.y - truth.y), 0.01);
}

TEST_P(ScanSlope, SaysNothingWhereNothingFits) {
  const auto weigher = readAt(learned(GetParam()), {1.0, 0.5, 0.0}, 0.0, 1);
  const Slope slope = dynamic_cast<const Polishable&>(*weigher).slopeAt({100.0, 100.0, 0.0});
  for (const double value : slope.information) EXPECT_EQ(value, 0.0);
  for (const double value : slope.pull) EXPECT_EQ(value, 0.0);
}

INSTANTIATE_TEST_SUITE_P(Perceptions, ScanSlope,
                         testing::Values(Perception::kRays, Perception::kEndPoints),
                         [](const auto& each) {
                           return each.param == Perception::kRays ? "Rays" : "EndPoints";
                         });

}  // namespace
}  // namespace ortung
