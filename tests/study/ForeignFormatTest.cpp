// A sensor with a class of its own gets what Ortung's own sensors get, though nothing outside of it
// knows the class.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "FakeRoom.hpp"
#include "MadeSource.hpp"
#include "Radar.hpp"
#include "ortung/run/ReadingValues.hpp"
#include "ortung/study/Evaluation.hpp"
#include "ortung/study/NoiseLearner.hpp"

namespace ortung::test {
namespace {

constexpr double kBeaconX = 2.5;
constexpr double kBeaconY = -1.0;
const SensorId kRadarId{"acme", "radar", "echoes"};

std::vector<std::uint32_t> echo(const Pose2& sensor, double rangeBias = 0.0) {
  return RadarData::encode(std::hypot(kBeaconX - sensor.x, kBeaconY - sensor.y) + rangeBias,
                           bearingTo(sensor, kBeaconX, kBeaconY));
}

class ForeignFormat : public testing::Test {
 protected:
  ForeignFormat() {
    learnEverywhere(radar, region, kPi / 4, [](const Pose2& sensor) { return echo(sensor); });
  }
  const Room room{8, 5};
  const FieldRegion region = room.region(0.1, 0.2);
  const Pose2 mount{0.2, 0.1, 0.3};
  RadarData radar{kRadarId, mount};
};

TEST_F(ForeignFormat, ItsValuesStandBesideWhatIsExpected) {
  const Pose2 pose{-1.0, 0.5, 0.7};
  radar.setData(1, echo(pose * mount, 0.25));
  const std::vector<ReadingValue> values = readingValues(radar, pose);
  ASSERT_EQ(values.size(), 2u);
  EXPECT_FALSE(values[0].isAngle);
  EXPECT_TRUE(values[1].isAngle);
  EXPECT_NEAR(*values[0].measured - *values[0].expected, 0.25, 2e-3);
  EXPECT_NEAR(*values[1].measured - *values[1].expected, 0.0, 1e-3);
  EXPECT_GT(radar.getProbability(pose), 0.0);
}

TEST_F(ForeignFormat, ItsNoiseIsLearned) {
  const TableInfo info{"room", "room-1", "robot", kPi / 90, region, {}};
  NoiseLog log;
  Random random(3);
  const auto poseAt = [](double t) {
    return Pose2{2.0 * std::cos(0.3 * t), 1.4 * std::sin(0.41 * t), wrapAngle(0.5 * t)};
  };
  for (double t = 0.0; t < 200.0; t += 0.02) log.reference.emplace_back(fromSeconds(t), poseAt(t));
  constexpr double kBias = 0.12;
  constexpr double kSigma = 0.04;
  for (double t = 1.0; t < 199.0; t += 0.1)
    log.readings[toText(kRadarId)].push_back(
        {fromSeconds(t), echo(poseAt(t) * mount, kBias + kSigma * random.gaussian())});
  SensorData* const features[] = {&radar};
  const LearnedNoise learned = learnNoise(features, info, {&log, 1}, {});
  const Learned& bias = learned.fit.terms[static_cast<std::size_t>(NoiseTerm::kRangeBias)];
  EXPECT_LT(std::abs(bias.value - kBias), 4.0 * bias.error + 1e-3);
  EXPECT_GT(learned.readings, 1000u);
}

TEST_F(ForeignFormat, ItHasFaults) {
  MadeRobot robot;
  robot.container.add(std::make_unique<RadarData>(kRadarId));
  std::vector<Message> messages;
  for (int i = 0; i < 1000; ++i)
    messages.push_back({i * 100'000, kRadarId, RadarData::encode(6.0, 0.1)});
  const std::uint32_t bearing = messages[0].words[1];
  int random = 0;
  for (const Message& m : robot.disturb(messages, {"readings=random:0.3"})) {
    random += m.words[1] != bearing ? 1 : 0;
    EXPECT_LE(m.words[0], 12'000u);
    EXPECT_LT(m.words[1], 36'000u);
  }
  EXPECT_NEAR(random, 300, 60);  // 4 sigma
  int tooNear = 0;
  for (const Message& m : robot.disturb(messages, {"acme/radar/echoes=short:0.5"})) {
    tooNear += m.words[0] < 6000 ? 1 : 0;
    EXPECT_EQ(m.words[1], bearing);
  }
  EXPECT_NEAR(tooNear, 500, 65);
  const auto frozen = robot.disturb(messages, {"acme/radar/echoes=frozen@10-20"});
  EXPECT_EQ(frozen.size(), messages.size());
  EXPECT_THROW(robot.disturb(messages, {"acme/radar/echoes=crowd"}), FaultError);
}

TEST_F(ForeignFormat, WordsThatItRefusesPassUnaltered) {
  MadeRobot robot;
  robot.container.add(std::make_unique<RadarData>(kRadarId));
  const std::vector<Message> hostile = {{0, kRadarId, {1}}, {1, kRadarId, {1, 40'000}}};
  EXPECT_EQ(robot.disturb(hostile, {"readings=random:1"}), hostile);
}

}  // namespace
}  // namespace ortung::test
