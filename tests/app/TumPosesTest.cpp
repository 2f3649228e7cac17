// Poses in the format of TUM's benchmark: seconds, x y z, and the quaternion x y z w.
#include <gtest/gtest.h>

#include <numbers>

#include "EstimatesText.hpp"

namespace ortung::app {
namespace {

std::string tum(Timestamp stamp, const Pose2& pose) {
  std::string text;
  appendTum(stamp, pose, text);
  return text;
}

// The quaternion of a turn by t about z is (0, 0, sin t/2, cos t/2).
TEST(TumPoses, HeadingsAreQuaternionsAboutTheVerticalAxis) {
  constexpr double kPi = std::numbers::pi;
  EXPECT_EQ(tum(0, {1.25, -2.5, 0.0}),
            "0.000000 1.250000 -2.500000 0 0 0 0.000000000 1.000000000\n");
  EXPECT_EQ(tum(0, {0, 0, kPi / 2}), "0.000000 0.000000 0.000000 0 0 0 0.707106781 0.707106781\n");
  EXPECT_EQ(tum(0, {0, 0, -kPi / 3}),
            "0.000000 0.000000 0.000000 0 0 0 -0.500000000 0.866025404\n");
}

TEST(TumPoses, StampsKeepTheirMicroseconds) {
  const auto seconds = [](Timestamp stamp) {
    const std::string text = tum(stamp, {});
    return text.substr(0, text.find(' '));
  };
  EXPECT_EQ(seconds(1'000'001), "1.000001");
  EXPECT_EQ(seconds(999'999), "0.999999");
  EXPECT_EQ(seconds(1'700'000'000'123'456), "1700000000.123456");
}

// -1.5 s are 2 s before zero and half a second on: written so, evo would read -2 + 0.5.
TEST(TumPoses, StampsBeforeZeroAreTheNumbersThatTheyAre) {
  for (const Timestamp stamp : {-1'500'000, -1'000'000, -1, -250'000, -2'000'001}) {
    const std::string text = tum(stamp, {});
    EXPECT_NEAR(std::stod(text), static_cast<double>(stamp) / 1e6, 1e-9) << text;
  }
}

}  // namespace
}  // namespace ortung::app
