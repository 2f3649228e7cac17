// A world with two poses from which it looks the same: one is half a turn about the origin away
// from the other. What readings say is given by a formula, so that it is known which is right.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "Lookalikes.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/base/Random.hpp"

namespace ortung {
namespace {

/// What a reading says against the wrong one of both poses [nats].
using Against = std::function<double(int reading)>;

class LookalikesTest : public testing::Test {
 protected:
  static Pose2 opposite(const Pose2& pose) {
    return {-pose.x, -pose.y, wrapAngle(pose.theta + std::numbers::pi)};
  }
  /// ln p(reading | pose): a peak at the robot, and the same less `against` at the opposite pose.
  Evidence evidence(double against) const {
    const auto fall = [](const Pose2& at, const Pose2& pose) {
      return -0.5 * (std::pow(distance(at, pose) / 0.1, 2) +
                     std::pow(wrapAngle(at.theta - pose.theta) / 0.05, 2));
    };
    const auto weigh = [robot = robot_, against, fall](const SampleSet& set,
                                                       std::vector<float>& logs) {
      logs.clear();
      for (std::size_t i = 0; i < set.size(); ++i) {
        const Pose2 pose{set.x[i], set.y[i], set.theta[i]};
        logs.push_back(static_cast<float>(
            std::max({fall(robot, pose), fall(opposite(robot), pose) - against, -20.0})));
      }
    };
    return {weigh, [](const SampleSet&) { return 1.0; }};
  }
  /// Moves the places, and compares them.
  void look(const Lookalikes::Moment& moment, const Evidence& evidence) {
    lookalikes_.follow(moment);
    lookalikes_.compare(moment, evidence);
  }
  /// The belief's places: the robot's pose, and the opposite one with the rest of the share.
  void begin(double share) {
    PoseEstimate own;
    own.pose = robot_;
    own.share = share;
    PoseEstimate other;
    other.pose = opposite(robot_);
    other.share = 1.0 - share;
    look({robot_, robot_, 0.0, Random(1, 0)}, evidence(0.0));
    lookalikes_.add(std::vector{own, other});
  }
  void drive(int readings, const Against& against, double step = 0.2) {
    for (int i = 0; i < readings; ++i) {
      robot_ = robot_ * Pose2{step, 0.0, 0.05};
      look({robot_, robot_, step, Random(2, static_cast<std::uint64_t>(i))}, evidence(against(i)));
    }
  }

  Pose2 robot_{2.0, 1.0, 0.3};
  const Building none_;
  Lookalikes lookalikes_{none_};
};

TEST_F(LookalikesTest, WithoutOthersTheEstimateHasAllOfTheShare) {
  EXPECT_TRUE(lookalikes_.isEmpty());
  EXPECT_EQ(lookalikes_.shareOfEstimate(), 1.0);
  EXPECT_EQ(lookalikes_.reach(0.001).metres, 0.0);
}

TEST_F(LookalikesTest, HaveWhatTheSamplesHad) {
  begin(0.75);
  EXPECT_NEAR(lookalikes_.shareOfEstimate(), 0.75, 1e-9);
  EXPECT_NEAR(lookalikes_.reach(0.001).metres, 2.0 * std::hypot(2.0, 1.0), 1e-6);
  EXPECT_NEAR(lookalikes_.reach(0.001).radians, std::numbers::pi, 1e-6);
}

TEST_F(LookalikesTest, AreNotRuledOutByChance) {
  begin(0.5);
  Random random(7, 0);
  double most = 0.0;
  for (int i = 0; i < 100; ++i) {
    drive(20, [&](int) { return 0.7 * random.gaussian(); });
    ASSERT_FALSE(lookalikes_.isEmpty()) << "after " << 20 * (i + 1) << " readings";
    most = std::max(most, lookalikes_.shareOfEstimate());
  }
  EXPECT_LT(most, 0.8) << "several places fit, all the time";
}

TEST_F(LookalikesTest, AreRuledOutByReadingsThatFitThereFarWorse) {
  begin(0.5);
  drive(3, [](int) { return 8.0; });
  EXPECT_GT(lookalikes_.shareOfEstimate(), 0.99);
  drive(3, [](int) { return 8.0; });
  EXPECT_TRUE(lookalikes_.isEmpty());
}

TEST_F(LookalikesTest, AreRuledOutByManyReadingsThatFitThereALittleWorse) {
  begin(0.5);
  Random random(7, 0);
  drive(300, [&](int) { return 0.5 + 0.5 * random.gaussian(); });
  EXPECT_TRUE(lookalikes_.isEmpty());
}

TEST_F(LookalikesTest, ReadingsFromOnePlaceDoNotCount) {
  begin(0.5);
  drive(100, [](int) { return 8.0; }, 0.0);
  EXPECT_NEAR(lookalikes_.shareOfEstimate(), 0.5, 0.01);
}

// Samples may swap places by chance; what was the estimate's place looks like it then.
TEST_F(LookalikesTest, ChangeRolesWithTheEstimate) {
  begin(0.6);
  robot_ = robot_ * Pose2{0.2, 0.0, 0.0};
  look({opposite(robot_), robot_, 0.2, Random(3, 0)}, evidence(0.0));
  ASSERT_FALSE(lookalikes_.isEmpty());
  EXPECT_NEAR(lookalikes_.reach(0.001).metres, 2.0 * std::hypot(robot_.x, robot_.y), 0.1);
  for (int i = 0; i < 6; ++i) {
    robot_ = robot_ * Pose2{0.2, 0.0, 0.05};
    look({opposite(robot_), robot_, 0.2, Random(4, static_cast<std::uint64_t>(i))}, evidence(8.0));
  }
  EXPECT_NEAR(lookalikes_.shareOfEstimate(), 0.5, 0.01) << "what speaks for one is no certainty";
}

TEST_F(LookalikesTest, FollowWithoutOdometryAsTheEstimateMoves) {
  begin(0.5);
  for (int i = 0; i < 50; ++i) {
    robot_ = robot_ * Pose2{0.2, 0.0, 0.05};
    look({robot_, std::nullopt, 0.2, Random(5, static_cast<std::uint64_t>(i))}, evidence(0.0));
  }
  EXPECT_NEAR(lookalikes_.reach(0.001).metres, 2.0 * std::hypot(robot_.x, robot_.y), 0.2);
  EXPECT_LT(lookalikes_.shareOfEstimate(), 0.8);
}

TEST_F(LookalikesTest, ClimbToWhereReadingsFit) {
  PoseEstimate own;
  own.pose = robot_;
  own.share = 0.5;
  PoseEstimate other = own;
  other.pose = opposite(robot_) * Pose2{0.2, -0.1, 0.08};
  look({robot_, robot_, 0.0, Random(1, 0)}, evidence(0.0));
  lookalikes_.add(std::vector{own, other});
  drive(20, [](int) { return 0.0; });
  EXPECT_NEAR(lookalikes_.reach(0.001).metres, 2.0 * std::hypot(robot_.x, robot_.y), 0.1);
  EXPECT_LT(lookalikes_.shareOfEstimate(), 0.8) << "it was only found a little beside";
}

TEST_F(LookalikesTest, OneThatIsTheEstimatesPlaceIsNone) {
  PoseEstimate own;
  own.pose = robot_;
  own.share = 0.5;
  PoseEstimate other = own;
  other.pose = robot_ * Pose2{0.1, 0.0, 0.0};
  look({robot_, robot_, 0.0, Random(1, 0)}, evidence(0.0));
  lookalikes_.add(std::vector{own, other});
  EXPECT_TRUE(lookalikes_.isEmpty());
}

TEST_F(LookalikesTest, AreForgotten) {
  begin(0.5);
  lookalikes_.forget();
  EXPECT_TRUE(lookalikes_.isEmpty());
  EXPECT_EQ(lookalikes_.shareOfEstimate(), 1.0);
}

/// Two equal floors 40 m apart: what is known of the pose on one is known of that on the other, so
/// readings never tell them apart, though the look-alike was first found beside.
TEST(LookalikesOfFloors, EqualFloorsAreNeverToldApart) {
  Building building;
  building.floors = {{"a", 0.0, -10.0, 20.0}, {"b", 40.0, 20.0, 60.0}};
  Pose2 robot{2.0, 1.0, 0.3};
  const Evidence evidence{
      [&](const SampleSet& set, std::vector<float>& logs) {
        logs.clear();
        for (std::size_t i = 0; i < set.size(); ++i) {
          const double x = static_cast<double>(set.x[i]);
          const Pose2 onFloor = building.floorOf(x).fromField(
              {x, static_cast<double>(set.y[i]), static_cast<double>(set.theta[i])});
          // Sharper than a look-alike climbs.
          logs.push_back(
              static_cast<float>(-0.5 * (std::pow(distance(onFloor, robot) / 0.02, 2) +
                                         std::pow((onFloor.theta - robot.theta) / 0.01, 2))));
        }
      },
      [](const SampleSet&) { return 1.0; }};
  Lookalikes lookalikes(building);
  PoseEstimate own;
  own.pose = robot;
  own.share = 0.5;
  PoseEstimate other = own;
  other.pose = {42.1, 1.1, 0.25};
  const auto look = [&](const Lookalikes::Moment& moment) {
    lookalikes.follow(moment);
    lookalikes.compare(moment, evidence);
  };
  look({robot, robot, 0.0, Random(1, 0)});
  lookalikes.add(std::vector{own, other});
  for (int i = 0; i < 300; ++i) {
    robot = robot * Pose2{0.05, 0.0, 0.05};
    look({robot, robot, 0.2, Random(2, static_cast<std::uint64_t>(i))});
    ASSERT_NEAR(lookalikes.shareOfEstimate(), 0.5, 0.05) << i;
    ASSERT_NEAR(lookalikes.floorShares()[0], 0.5, 0.05) << i;
    ASSERT_NEAR(lookalikes.floorShares()[1], 0.5, 0.05) << i;
  }
}

/// Without time for comparisons the places are moved all the same, and say what they said before.
TEST_F(LookalikesTest, MoveWhileThereIsNoTimeToCompareThem) {
  begin(0.75);
  for (int i = 0; i < 50; ++i) {
    robot_ = robot_ * Pose2{0.2, 0.0, 0.05};
    lookalikes_.follow({robot_, robot_, 0.2, Random(6, static_cast<std::uint64_t>(i))});
  }
  EXPECT_NEAR(lookalikes_.shareOfEstimate(), 0.75, 1e-9);
  EXPECT_NEAR(lookalikes_.reach(0.001).metres, 2.0 * std::hypot(robot_.x, robot_.y), 1e-6);
}

}  // namespace
}  // namespace ortung
