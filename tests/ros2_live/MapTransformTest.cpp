// map -> odom: told with each odometry and each correction, at times that rise.
#include <gtest/gtest.h>

#include <vector>

#include "MapTransform.hpp"
#include "ortung/ros2/Messages.hpp"

namespace ortung::ros2 {
namespace {

class MapTransformTest : public testing::Test {
 protected:
  MapTransformTest() {
    transform_.sendBy([this](std::string_view cdr) {
      std::string why;
      const auto message = fromCdr<TfMessage>(cdr, why);
      ASSERT_TRUE(message && message->transforms.size() == 1u) << why;
      told_.push_back(message->transforms.front());
    });
  }
  MapTransform transform_{{"map", "odom", 0.5}};
  std::vector<TransformStamped> told_;
};

TEST_F(MapTransformTest, NothingIsToldBeforeThePlaceIsKnown) {
  transform_.follow(1'000'000);
  EXPECT_TRUE(told_.empty());
  EXPECT_FALSE(transform_.isKnown());
  transform_.correct({1.0, 2.0, 0.0});
  ASSERT_EQ(told_.size(), 1u);
  EXPECT_TRUE(transform_.isKnown());
  EXPECT_EQ(told_[0].header.stamp, 1'500'000'000);
  EXPECT_EQ(told_[0].header.frame, "map");
  EXPECT_EQ(told_[0].childFrame, "odom");
  EXPECT_EQ(told_[0].transform.position.x, 1.0);
}

TEST_F(MapTransformTest, EachTimeIsToldOnce) {
  transform_.correct({});
  transform_.follow(1'000'000);
  transform_.follow(1'000'000);
  transform_.correct({});  // the same
  EXPECT_EQ(told_.size(), 1u);
  transform_.correct({1.0, 0.0, 0.0});
  transform_.correct({2.0, 0.0, 0.0});
  transform_.follow(1'000'001);  // was told already
  transform_.follow(1'020'000);
  ASSERT_EQ(told_.size(), 4u);
  for (std::size_t i = 1; i < told_.size(); ++i)
    EXPECT_GT(told_[i].header.stamp, told_[i - 1].header.stamp);
  EXPECT_EQ(told_[2].header.stamp, 1'500'002'000);
  EXPECT_EQ(told_[3].transform.position.x, 2.0);
}

TEST_F(MapTransformTest, FollowsAClockThatWasSetBack) {
  transform_.correct({});
  transform_.follow(100'000'000);
  transform_.follow(5'000'000);
  ASSERT_EQ(told_.size(), 2u);
  EXPECT_EQ(told_[1].header.stamp, 5'500'000'000);
  transform_.correct({1.0, 0.0, 0.0});
  EXPECT_EQ(told_.back().header.stamp, 5'500'001'000);
}

}  // namespace
}  // namespace ortung::ros2
