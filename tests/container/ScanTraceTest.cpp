// Where the beams of a scan end in the field, in a room of which all is known.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>

#include "FakeRoom.hpp"
#include "ortung/core/Traceable.hpp"

namespace ortung {
namespace {

using test::kPi;
using Perception = ScanData::Perception;

const test::Room kRoom;
const Pose2 kMount{0.1, -0.05, 0.3};
const Pose2 kPose{0.4, 0.3, 0.7};

ScanData::Config configOf(Perception perception) {
  ScanData::Config c{.beams = 91, .firstAngle = -kPi / 2, .angleStep = kPi / 90, .maxRange = 9.0};
  c.perception = perception;
  c.model = {.sigma = 0.02, .sigmaPerMetre = 0.01, .outliers = 0.05, .exponent = 0.3};
  return c;
}

class ScanTraceTest : public testing::TestWithParam<Perception> {
 protected:
  ScanTraceTest() {
    test::learnEverywhere(data_, kRoom.region(0.1, 0.2), kPi / 90,
                          [&](const Pose2& s) { return scanWords(kRoom, s, data_.config()); });
    const Pose2 sensor = kPose * kMount;
    for (int i = 0; i < 91; ++i)
      ranges_.push_back(static_cast<float>(kRoom.range(
          sensor.x, sensor.y, sensor.theta + data_.config().firstAngle + i * kPi / 90)));
  }

  std::shared_ptr<const Weigher> read(const std::vector<float>& ranges) {
    std::vector<std::uint32_t> words;
    ScanData::encode(ranges, data_.config().maxRange, words);
    data_.setData(++now_, words);
    return data_.weigher();
  }

  ScanData data_{SensorId{"M", "T", "F"}, kMount, configOf(GetParam())};
  std::vector<float> ranges_;
  Timestamp now_ = 0;
};

TEST_P(ScanTraceTest, TellsWhereBeamsBeginAndWhatIsExpected) {
  const auto weigher = read(ranges_);
  const auto* traceable = dynamic_cast<const Traceable*>(weigher.get());
  ASSERT_NE(traceable, nullptr);
  std::vector<TracedBeam> beams;
  traceable->trace(kPose, beams);
  ASSERT_EQ(beams.size(), 91U);
  const Pose2 sensor = kPose * kMount;
  for (std::size_t i = 0; i < beams.size(); ++i) {
    EXPECT_NEAR(beams[i].x, sensor.x, 1e-12);
    EXPECT_NEAR(beams[i].y, sensor.y, 1e-12);
    EXPECT_NEAR(beams[i].bearing, sensor.theta - kPi / 2 + static_cast<double>(i) * kPi / 90, 1e-9);
    EXPECT_NEAR(beams[i].read, ranges_[i], 0.001) << "words are millimetres";
    EXPECT_NEAR(beams[i].expected, ranges_[i], 0.06) << i;
    EXPECT_LT(beams[i].away, 0.03) << i;
    EXPECT_NEAR(beams[i].sigma, 0.02 + 0.01 * beams[i].expected, 0.03);
  }
}

TEST_P(ScanTraceTest, TellsHowFarEndsAreFromAllThatWasLearned) {
  std::vector<float> shorter = ranges_;
  shorter[40] -= 0.2F;
  shorter[45] -= 1.0F;
  shorter[50] = std::numeric_limits<float>::infinity();
  shorter[55] = std::numeric_limits<float>::quiet_NaN();
  const auto weigher = read(shorter);
  std::vector<TracedBeam> beams;
  dynamic_cast<const Traceable&>(*weigher).trace(kPose, beams);
  ASSERT_EQ(beams.size(), 90U) << "one is not valid";
  EXPECT_GT(beams[40].away, 0.05);
  EXPECT_LT(beams[40].away, 0.21);
  EXPECT_TRUE(std::isinf(beams[45].away));
  EXPECT_TRUE(std::isinf(beams[50].read));
  EXPECT_TRUE(std::isinf(beams[50].away));
  EXPECT_NEAR(beams[55].read, ranges_[56], 0.001) << "those behind it follow";
}

TEST_P(ScanTraceTest, IsEmptyOutsideOfWhatWasLearned) {
  const auto weigher = read(ranges_);
  std::vector<TracedBeam> beams;
  dynamic_cast<const Traceable&>(*weigher).trace({500.0, 0.0, 0.0}, beams);
  EXPECT_TRUE(beams.empty());
}

TEST_P(ScanTraceTest, LeavesOutBeamsAsIfTheyWereNotValid) {
  std::vector<float> holes = ranges_;
  holes[10] = std::numeric_limits<float>::quiet_NaN();
  const auto weigher = read(holes);
  std::vector<bool> dropped(90, false);
  for (std::size_t i = 30; i < 60; ++i) dropped[i] = true;
  const auto rest = dynamic_cast<const Traceable&>(*weigher).without(dropped);
  ASSERT_TRUE(rest);
  std::vector<float> without = holes;
  for (std::size_t i = 31; i < 61; ++i) without[i] = std::numeric_limits<float>::quiet_NaN();
  const auto expected = read(without);
  for (const Pose2& pose : {kPose, Pose2{0.5, 0.2, 0.8}, Pose2{-0.5, 0.1, 2.0}})
    EXPECT_EQ(rest->getProbability(pose), expected->getProbability(pose));
  EXPECT_FALSE(dynamic_cast<const Traceable&>(*weigher).without(std::vector<bool>(90, true)))
      << "nothing is left";
}

INSTANTIATE_TEST_SUITE_P(Perceptions, ScanTraceTest,
                         testing::Values(Perception::kRays, Perception::kEndPoints),
                         [](const auto& perception) {
                           return perception.param == Perception::kRays ? "rays" : "ends";
                         });

}  // namespace
}  // namespace ortung
