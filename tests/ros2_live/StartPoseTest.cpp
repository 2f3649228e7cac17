#include <gtest/gtest.h>

#include <numbers>

#include "StartPose.hpp"

namespace ortung::ros2 {
namespace {

TEST(StartPose, IsThreeNumbersWithTheHeadingInDegrees) {
  const auto pose = parseStartPose("1.5,-2,90");
  ASSERT_TRUE(pose);
  EXPECT_EQ(pose->x, 1.5);
  EXPECT_EQ(pose->y, -2.0);
  EXPECT_NEAR(pose->theta, std::numbers::pi / 2.0, 1e-12);
  EXPECT_NEAR(parseStartPose("0,0,270 ")->theta, -std::numbers::pi / 2.0, 1e-12);
}

TEST(StartPose, IsNothingElse) {
  for (const char* text : {"", "1,2", "1,2,", "1;2;3", "1,2,3,4", "1,2,3x", "global", "nan,0,0"})
    EXPECT_FALSE(parseStartPose(text)) << text;
}

}  // namespace
}  // namespace ortung::ros2
