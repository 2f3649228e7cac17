/// What an emulated base and home-made lines send, with their clocks and the speed of their lines.
#include <gtest/gtest.h>

#include <numbers>

#include "ortung/emulators/EmulatedBase.hpp"
#include "ortung/emulators/EmulatedLines.hpp"
#include "ortung/formats/BearingData.hpp"
#include "ortung/formats/ConeData.hpp"
#include "ortung/formats/OdometryData.hpp"

namespace ortung {
namespace {

using namespace base_lines;

const SensorId kWheels{"odometry", "odometry", "pose"};
const SensorId kLeft{"sonar", "ultrasonic", "left"};
const SensorId kRight{"sonar", "ultrasonic", "right"};

/// The telegrams that a device has sent completely by a time.
std::vector<Telegram> sent(EmulatedDevice& device, Timestamp now) {
  std::vector<Telegram> telegrams;
  for (const auto& [bytes, baud] : device.takeOutput(now)) {
    EXPECT_TRUE(bytes.ends_with("\r\n"));
    const auto telegram = decode(bytes.substr(0, bytes.size() - 2));
    EXPECT_TRUE(telegram) << bytes;
    if (telegram) telegrams.push_back(*telegram);
  }
  return telegrams;
}

/// A base with wheels and two sonars, the right one of which sees farther.
struct Base : testing::Test {
  Base()
      : wheels(kWheels),
        left(kLeft, {}, config(3.0)),
        right(kRight, {}, config(5.0)),
        features{&left, &wheels, &right},
        base(features, 115200) {}
  static ConeData::Config config(double range) {
    ConeData::Config cone;
    cone.maxRange = range;
    return cone;
  }
  OdometryData wheels;
  ConeData left, right;
  std::vector<const SensorData*> features;
  EmulatedBase base;
};

TEST(BaseOutput, IsDroppedWhenTheBaseIsAsked) {
  const OdometryData wheels(kWheels);
  const std::vector<const SensorData*> features{&wheels};
  EmulatedBase base(features, 9600);
  for (int i = 0; i < 100; ++i) base.sense({0, kWheels, OdometryData::encode({})}, 0);
  base.receive(encode(base_lines::Question{}), 100);
  const auto said = base.takeOutput(1'000'000);
  ASSERT_EQ(said.size(), 1U);
  EXPECT_EQ(said.front().bytes, encode(Identity{1, 0}));
}

TEST_F(Base, AnswersWhatItIsAndMeasuresFromThenOn) {
  EXPECT_FALSE(base.isMeasuring());
  base.receive("noise\r\n" + encode(base_lines::Question{}).substr(0, 4), 0);
  EXPECT_FALSE(base.isMeasuring());
  base.receive(encode(base_lines::Question{}).substr(4), 0);
  const auto told = sent(base, 1'000'000);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(std::get<Identity>(told[0]).version, 1u);
  EXPECT_EQ(std::get<Identity>(told[0]).sonars, 2u);
  EXPECT_TRUE(base.isMeasuring());
}

// Stamps are the base's clock's: 5 s ahead, and 1000 ppm too fast.
TEST_F(Base, SendsOdometryWithItsOwnTime) {
  base.clock.offset = 5.0;
  base.clock.driftPpm = 1000.0;
  OdometryData::Reading state;
  state.pose = {1.5, -0.25, std::numbers::pi / 2};
  state.translationalVelocity = 0.5;
  state.rotationalVelocity = -std::numbers::pi / 4;
  state.lateralVelocity = 0.125;
  state.motionData = {7};
  base.sense({0, kWheels, OdometryData::encode(state)}, 2'000'000);
  const auto told = sent(base, 3'000'000);
  ASSERT_EQ(told.size(), 1u);
  const auto& odometry = std::get<Odometry>(told[0]);
  EXPECT_EQ(odometry.time, 7002u);
  EXPECT_NEAR(odometry.pose.x, 1.5, 1e-9);
  EXPECT_NEAR(odometry.pose.y, -0.25, 1e-9);
  EXPECT_NEAR(odometry.pose.theta, std::numbers::pi / 2, 1e-9);
  EXPECT_NEAR(odometry.translationalVelocity, 0.5, 1e-9);
  EXPECT_NEAR(odometry.rotationalVelocity, -std::numbers::pi / 4, 1e-9);
  EXPECT_NEAR(odometry.lateralVelocity, 0.125, 1e-9);
  EXPECT_EQ(odometry.motionData, std::vector<std::uint32_t>{7});
}

TEST_F(Base, NumbersItsSonarsInTheirOrderAndKnowsHowFarEachSees) {
  const auto echo = [&](const SensorId& id, std::uint32_t word) {
    base.sense({0, id, {word}}, 0);
    return sent(base, 1'000'000);
  };
  for (const auto& [id, number, nothing] : {std::tuple{kLeft, 0u, 3000u}, {kRight, 1u, 5000u}}) {
    const auto seen = echo(id, nothing - 1);
    ASSERT_EQ(seen.size(), 1u);
    EXPECT_EQ(std::get<Sonars>(seen[0]).first, number);
    EXPECT_EQ(std::get<Sonars>(seen[0]).echoes, std::vector<std::uint32_t>{nothing - 1});
    const auto unseen = echo(id, nothing);
    ASSERT_EQ(unseen.size(), 1u);
    EXPECT_EQ(std::get<Sonars>(unseen[0]).echoes, std::vector<std::uint32_t>{0});
    EXPECT_TRUE(echo(id, 0).empty()) << "it did not measure";
  }
  EXPECT_TRUE(echo({"other", "ultrasonic", "left"}, 1000).empty());
}

TEST_F(Base, HoldsACommandForHalfASecond) {
  EXPECT_FALSE(base.command(0));
  base.receive(encode(Velocity{0.25, -0.5}), 1'000'000);
  ASSERT_TRUE(base.command(1'500'000));
  EXPECT_NEAR(base.command(1'500'000)->translational, 0.25, 1e-9);
  EXPECT_NEAR(base.command(1'500'000)->rotational, -0.5, 1e-4);
  EXPECT_FALSE(base.command(1'500'001));
  base.receive(encode(Velocity{0.5, 0.0}), 1'600'000);
  EXPECT_NEAR(base.command(1'600'000)->translational, 0.5, 1e-9);
}

TEST_F(Base, HasOneOdometryAndSonarsAlone) {
  const BearingData compass({"compass", "compass", "north"}, {}, {});
  const std::vector<const SensorData*> twice{&wheels, &wheels}, other{&wheels, &compass};
  for (const auto& wrong : {twice, other}) {
    std::string why;
    try {
      const EmulatedBase none(wrong, 115200);
    } catch (const std::invalid_argument& error) {
      why = error.what();
    }
    EXPECT_EQ(why, toText(wrong[1]->id()) + " is neither a sonar nor the only odometry");
  }
}

TEST(EmulatedLines, SendTheirReadingsAsLinesOfTheirClock) {
  const BearingData compass({"compass", "compass", "north"}, {}, {});
  const std::vector<const SensorData*> features{&compass};
  EmulatedLines device(features);
  device.clock.offset = -0.5;
  EXPECT_TRUE(device.isMeasuring());
  EXPECT_FALSE(device.baud());
  device.sense({77, compass.id(), {18000}}, 2'000'000);
  device.sense({77, {"other", "compass", "north"}, {18000}}, 2'000'000);
  const auto out = device.takeOutput(2'000'000);
  ASSERT_EQ(out.size(), 1u) << "a socket takes no time";
  EXPECT_EQ(out[0].bytes, "1500000 compass/compass/north 1 18000\n");
  EXPECT_FALSE(out[0].baud);
}

// Ten bits a byte, one telegram after the other: "1500000 compass/compass/north 1 18000\n" are 38
// bytes, which take 39583 us at 9600 baud.
TEST(EmulatedLines, ASlowLineDelaysWhatItSends) {
  const BearingData compass({"compass", "compass", "north"}, {}, {});
  const std::vector<const SensorData*> features{&compass};
  EmulatedLines device(features, 9600);
  EXPECT_FALSE(device.due());
  device.sense({0, compass.id(), {18000}}, 1'500'000);
  device.sense({0, compass.id(), {18000}}, 1'500'000);
  EXPECT_EQ(device.due(), 1'539'583);
  EXPECT_TRUE(device.takeOutput(1'539'582).empty());
  const auto first = device.takeOutput(1'539'583);
  ASSERT_EQ(first.size(), 1u);
  EXPECT_EQ(first[0].baud, 9600);
  EXPECT_EQ(device.due(), 1'579'166) << "behind the first one";
  EXPECT_EQ(device.takeOutput(2'000'000).size(), 1u);
  device.sense({0, compass.id(), {18000}}, 3'000'000);
  EXPECT_EQ(device.due(), 3'039'583) << "a free line begins at once";
}

TEST(EmulatedLines, ALineThatNobodyReadsKeepsTenThousandTelegrams) {
  const BearingData compass({"compass", "compass", "north"}, {}, {});
  const std::vector<const SensorData*> features{&compass};
  EmulatedLines device(features);
  for (int i = 0; i < 10'005; ++i) device.sense({0, compass.id(), {18000}}, i);
  EXPECT_EQ(device.takeOutput(20'000).size(), 10'000u);
}

}  // namespace
}  // namespace ortung
