#include <gtest/gtest.h>

#include <cmath>

#include "FakeRoom.hpp"
#include "ortung/formats/LandmarksData.hpp"

namespace ortung {
namespace {

// What is farther off than the sensor reaches is not expected there: neither how far nor where.
TEST(LandmarksLearning, SightingsBeyondTheGreatestRangeTeachNothing) {
  LandmarksData::Config config;
  config.identities = {7, 8};
  config.maxRange = 5.0;
  LandmarksData data({"camera", "test", "posts"}, {}, config);
  data.beginLearning(test::Room{}.region(0.5, 0.2), 0.1);
  data.setData(1, LandmarksData::encode({{7, 4.9, 0.3}, {8, 5.2, -0.4}}));
  const Pose2 pose{0.1, 0.1, 0.2};
  data.learnProbability(pose);
  data.endLearning();
  const std::vector<double> expected = data.expectation(pose);
  ASSERT_EQ(expected.size(), 4u);
  EXPECT_NEAR(expected[0], 4.9, 0.05);
  EXPECT_NEAR(expected[1], 0.3, 0.05);
  EXPECT_TRUE(std::isnan(expected[2])) << expected[2];
  EXPECT_TRUE(std::isnan(expected[3])) << expected[3];
}

}  // namespace
}  // namespace ortung
