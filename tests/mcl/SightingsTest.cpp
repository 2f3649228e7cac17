// What searches say that have found a place alone, one after the other.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "Sightings.hpp"

namespace ortung {
namespace {

constexpr double kFarBetter = 1000.0;  // ln p(reading | place) - ln p(reading | belief)
constexpr double kAtMost = 9.0;        // nats of one sighting

/// Where a robot is that odometry has at @p odometry, if it was at @p place when odometry was at
/// the origin.
Pose2 ledTo(const Pose2& place, const Pose2& odometry) { return place * odometry; }

TEST(Sightings, OneSaysAsMuchAsAReadingOfAUniquePlace) {
  EXPECT_EQ(Sightings().see({3, 4, 1}, kFarBetter, Pose2()), kAtMost);
  EXPECT_EQ(Sightings().see({3, 4, 1}, 2.5, Pose2()), 2.5);
  EXPECT_EQ(Sightings().see({3, 4, 1}, -2.5, Pose2()), -2.5) << "the belief explains it better";
}

TEST(Sightings, AddUpWhereOdometryLeads) {
  const Pose2 place{3, 4, 1};
  Sightings sightings;
  double nats = 0.0;
  for (const Pose2& odometry :
       {Pose2{0, 0, 0}, Pose2{1, 0.2, 0.5}, Pose2{1, 0.2, -3}, Pose2{0, 1, 2}}) {
    nats += kAtMost;
    EXPECT_EQ(sightings.see(ledTo(place, odometry), kFarBetter, odometry), nats);
  }
  EXPECT_EQ(sightings.see(ledTo(place, {2, 2, 2}), -1.0, Pose2{2, 2, 2}), nats - 1.0);
}

TEST(Sightings, OdometryMayErrByHalfOfTheWay) {
  for (const double off : {0.14, -0.14, 0.16, -0.16, 3.0}) {
    Sightings sightings;
    sightings.see({}, kFarBetter, Pose2());
    const double nats = sightings.see({0.3 + off, 0, 0}, kFarBetter, Pose2{0.3, 0, 0});
    EXPECT_EQ(nats, std::abs(off) < 0.15 ? 2 * kAtMost : kAtMost) << off;
  }
  for (const double off : {0.49, 0.51}) {
    Sightings sightings;
    sightings.see({}, kFarBetter, Pose2());
    const double nats = sightings.see({7, off, 0}, kFarBetter, Pose2{7, 0, 0});
    EXPECT_EQ(nats, off < 0.5 ? 2 * kAtMost : kAtMost) << "and by the extent of a place at most";
  }
}

// People who walk beside the robot are seen again and again.
TEST(Sightings, ThatComeAlongWithTheRobotSayNoMoreThanOne) {
  for (const Pose2& step :
       {Pose2{0.3, 0, 0}, Pose2{1, 0, 0}, Pose2{0, 0, 0.4}, Pose2{0.2, 0.1, 0.1}}) {
    Sightings sightings;
    Pose2 odometry;
    for (int i = 0; i < 20; ++i, odometry = odometry * step)
      EXPECT_EQ(sightings.see({3, 4, 1}, kFarBetter, odometry), kAtMost) << step.x << ", " << i;
  }
}

TEST(Sightings, FromOnePlaceSayNoMoreThanOneUntilTheRobotHasMoved) {
  Sightings sightings;
  const Pose2 place{3, 4, 1};
  for (int i = 0; i < 50; ++i) EXPECT_EQ(sightings.see(place, kFarBetter, Pose2()), kAtMost);
  const std::array<double, 6> nats{9.0, 9.0, 18.0, 18.0, 18.0, 27.0};
  for (int i = 1; i <= 6; ++i) {
    const Pose2 odometry{0.101 * i, 0, 0};
    EXPECT_EQ(sightings.see(ledTo(place, odometry), kFarBetter, odometry),
              nats.at(static_cast<std::size_t>(i - 1)))
        << i;
  }
}

TEST(Sightings, ElsewhereBeginAnewEvenIfTheRobotStands) {
  Sightings sightings;
  sightings.see({}, kFarBetter, Pose2());
  sightings.see({1, 0, 0}, kFarBetter, Pose2{1, 0, 0});
  EXPECT_EQ(sightings.see({5, 0, 0}, kFarBetter, Pose2{1, 0, 0}), kAtMost);
  EXPECT_EQ(sightings.see({6, 0, 0}, kFarBetter, Pose2{2, 0, 0}), 2 * kAtMost)
      << "this is the one now";
}

TEST(Sightings, OfRobotsWithoutOdometryAreNotCompared) {
  Sightings sightings;
  for (int i = 0; i < 5; ++i) EXPECT_EQ(sightings.see({1, 2, 3}, kFarBetter, {}), kAtMost);
  sightings.see({}, kFarBetter, Pose2());
  EXPECT_EQ(sightings.see({1, 0, 0}, kFarBetter, {}), kAtMost);
  EXPECT_EQ(sightings.see({2, 0, 0}, kFarBetter, Pose2{2, 0, 0}), kAtMost);
}

TEST(Sightings, AreForgotten) {
  Sightings sightings;
  sightings.see({}, kFarBetter, Pose2());
  sightings.forget();
  EXPECT_EQ(sightings.see({1, 0, 0}, kFarBetter, Pose2{1, 0, 0}), kAtMost);
}

}  // namespace
}  // namespace ortung
