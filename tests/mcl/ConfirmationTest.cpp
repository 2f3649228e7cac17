// Whether a place that a global start has chosen is confirmed by what comes after.
#include <gtest/gtest.h>

#include "Confirmation.hpp"
#include "FakeRun.hpp"
#include "ortung/mcl/Mcl.hpp"

namespace ortung {
namespace {

/// How many readings, each after so much way, it takes; most: it is open still.
int readingsUntilConfirmed(double way, int most, int fitsEvery = 1) {
  Confirmation confirmation;
  confirmation.begin();
  for (int i = 1; i <= most; ++i) {
    EXPECT_TRUE(confirmation.isOpen());
    confirmation.count(i % fitsEvery == 0, way);
    if (!confirmation.isOpen()) return i;
  }
  return most;
}

TEST(Confirmation, TakesAMetreOfWay) { EXPECT_EQ(readingsUntilConfirmed(0.125, 100), 8); }

TEST(Confirmation, TakesThreeReadingsHoweverFarApart) {
  EXPECT_EQ(readingsUntilConfirmed(5.0, 100), 3);
}

TEST(Confirmation, IsNoneOfARobotThatStands) { EXPECT_EQ(readingsUntilConfirmed(0.0, 100), 100); }

TEST(Confirmation, CountsReadingsThatFitAlone) {
  EXPECT_EQ(readingsUntilConfirmed(0.125, 100, 3), 24);
}

TEST(Confirmation, IsOfAChosenPlaceOnly) {
  Confirmation confirmation;
  EXPECT_FALSE(confirmation.isOpen());
  confirmation.begin();
  confirmation.forget();
  EXPECT_FALSE(confirmation.isOpen());
  confirmation.begin();
  confirmation.count(true, 10);
  confirmation.begin();
  confirmation.count(true, 10);
  confirmation.count(true, 10);
  EXPECT_TRUE(confirmation.isOpen()) << "readings of another start do not count";
}

// The same right place, told to the filter and found by it.
TEST(Confirmation, HoldsBackTrackingAfterAGlobalStartOnly) {
  test::FakeRun run;
  MclConfig config = run.config();
  config.budgetMs = 1e6;
  const auto unknown = run.mcl(config);
  const auto known = run.mcl(config);
  const Pose2 start = test::FakeRun::onCircle(1, 0.5, 0.3);
  unknown->startGlobal();
  known->startAt(start, 0.1, 0.05);
  run.begin(start, 3);
  int confirmedAfter = 0;
  int unconfirmed = 0;
  for (int i = 1; i <= 80; ++i) {
    i <= 40 ? run.drive(0, 0) : run.drive();
    unknown->update(run.container);
    known->update(run.container);
    if (i <= 3) continue;  // until both have begun
    ASSERT_LT(distance(unknown->estimate().pose, run.truth), 0.3);
    if (i <= 40 || i > 60) {  // until its motion has told that the stamps are right
      EXPECT_EQ(known->estimate().status, TrackStatus::kTracking) << i;
    }
    const bool isTracking = unknown->estimate().status == TrackStatus::kTracking;
    if (isTracking && confirmedAfter == 0) confirmedAfter = i;
    EXPECT_EQ(isTracking, confirmedAfter > 0) << i;
    unconfirmed += unknown->estimate().reason == TrackReason::kUnconfirmed ? 1 : 0;
  }
  EXPECT_GT(confirmedAfter, 44);
  EXPECT_GT(unconfirmed, 0);
}

}  // namespace
}  // namespace ortung
