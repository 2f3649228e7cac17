// What is told of steps: those of filters that follow one another, and those of the transform.
#include <gtest/gtest.h>

#include "RelocalizationCount.hpp"
#include "ortung/base/Angles.hpp"

namespace ortung::ros2 {
namespace {

PoseEstimate filterOf(std::uint32_t count, Relocalization cause) {
  PoseEstimate estimate;
  estimate.relocalizations = count;
  estimate.relocalization = cause;
  return estimate;
}

TEST(RelocalizationCount, GoesOnOverFilters) {
  RelocalizationCount count;
  EXPECT_FALSE(count.follow(filterOf(0, Relocalization::kNone), std::nullopt));
  EXPECT_TRUE(count.follow(filterOf(2, Relocalization::kOtherPlace), std::nullopt));
  EXPECT_FALSE(count.follow(filterOf(2, Relocalization::kOtherPlace), std::nullopt));
  EXPECT_EQ(count.count(), 2u);
  EXPECT_EQ(count.cause(), Relocalization::kOtherPlace);
  count.beginFilter();
  EXPECT_TRUE(count.follow(filterOf(1, Relocalization::kGiven), std::nullopt));
  EXPECT_EQ(count.count(), 3u);
  EXPECT_EQ(count.cause(), Relocalization::kGiven);
  EXPECT_TRUE(count.follow(filterOf(0, Relocalization::kNone), std::nullopt));
  EXPECT_EQ(count.count(), 4u);
}

TEST(RelocalizationCount, HasEachStepOfTheRobotInTheMap) {
  RelocalizationCount count;
  const PoseEstimate filter = filterOf(1, Relocalization::kFound);
  const Pose2 robot{10.0, 0.0, 0.0};
  EXPECT_TRUE(count.follow(filter, {{{1.0, 2.0, 0.0}, robot}}));
  EXPECT_FALSE(count.follow(filter, {{{1.0, 2.09, 0.0}, robot}}));
  EXPECT_FALSE(count.follow(filter, {{{1.0, 2.18, 0.0}, robot}}));
  EXPECT_EQ(count.count(), 1u);
  // A degree turns a robot ten metres away by 0.17 m, and one that is near hardly.
  EXPECT_TRUE(count.follow(filter, {{{1.0, 2.18, kDegree}, robot}}));
  EXPECT_EQ(count.count(), 2u);
  EXPECT_EQ(count.cause(), Relocalization::kReadings);
  EXPECT_FALSE(count.follow(filter, {{{1.0, 2.18, 0.0}, {0.1, 0.0, 0.0}}}));
  EXPECT_TRUE(count.follow(filter, {{{1.0, 2.18, 3.1 * kDegree}, {}}}));
}

TEST(RelocalizationCount, TellsAgainWhenATransformThatStoodStillFollows) {
  RelocalizationCount count;
  EXPECT_TRUE(count.follow(filterOf(1, Relocalization::kFound), {{{}, {}}}));
  EXPECT_TRUE(count.follow(filterOf(2, Relocalization::kOtherPlace), std::nullopt));  // lost
  EXPECT_FALSE(count.follow(filterOf(2, Relocalization::kOtherPlace), std::nullopt));
  EXPECT_TRUE(count.follow(filterOf(2, Relocalization::kOtherPlace), {{{3.0, 0.0, 0.0}, {}}}));
  EXPECT_EQ(count.count(), 3u);
}

TEST(RelocalizationCount, CountsARelocalizationAndItsStepOnce) {
  RelocalizationCount count;
  EXPECT_TRUE(count.follow(filterOf(1, Relocalization::kFound), {{{}, {}}}));
  EXPECT_TRUE(count.follow(filterOf(2, Relocalization::kOtherPlace), {{{3.0, 0.0, 0.0}, {}}}));
  EXPECT_EQ(count.count(), 2u);
  EXPECT_FALSE(count.follow(filterOf(2, Relocalization::kOtherPlace), {{{3.0, 0.0, 0.0}, {}}}));
}

}  // namespace
}  // namespace ortung::ros2
