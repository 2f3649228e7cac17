#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "MapWatch.hpp"

namespace ortung {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr Timestamp kSecond = 1'000'000;
constexpr Timestamp kDay = 86'400 * kSecond;
constexpr double kFarthest = 12.0;

/// An upright wall at a place in x, from one y to another.
struct Wall {
  double x;
  double fromY;
  double toY;
};
using Room = std::vector<Wall>;

/// Closed-form range along a ray.
double rangeIn(const Room& room, double x, double y, double bearing) {
  double least = kFarthest;
  for (const Wall& wall : room) {
    const double range = (wall.x - x) / std::cos(bearing);
    const double at = y + range * std::sin(bearing);
    if (range > 0.0 && at >= wall.fromY && at <= wall.toY) least = std::min(least, range);
  }
  return least < kFarthest ? least : kInfinity;
}

double distanceFrom(const Room& room, double x, double y) {
  double least = kInfinity;
  for (const Wall& wall : room)
    least = std::min(least, std::hypot(x - wall.x, y - std::clamp(y, wall.fromY, wall.toY)));
  return least;
}

/// A scan of one room, where another one was learned.
class RoomScan final : public Weigher, public Traceable {
 public:
  RoomScan(Room world, Room learned, const Pose2& truth, std::vector<bool> dropped = {})
      : world_(std::move(world)),
        learned_(std::move(learned)),
        truth_(truth),
        dropped_(std::move(dropped)) {}

  void trace(const Pose2& pose, std::vector<TracedBeam>& beams) const override {
    for (int degree = -90; degree <= 90; ++degree) {
      const double angle = degree * std::numbers::pi / 180.0;
      const double read = rangeIn(world_, truth_.x, truth_.y, truth_.theta + angle);
      beams.push_back({pose.x, pose.y, pose.theta + angle, read,
                       rangeIn(learned_, pose.x, pose.y, pose.theta + angle),
                       distanceFrom(learned_, pose.x + read * std::cos(pose.theta + angle),
                                    pose.y + read * std::sin(pose.theta + angle)),
                       kFarthest, 0.01});
    }
  }
  std::shared_ptr<const Weigher> without(const std::vector<bool>& dropped) const override {
    return std::make_shared<RoomScan>(world_, learned_, truth_, dropped);
  }
  const std::vector<bool>& dropped() const { return dropped_; }

 private:
  void weigh(const SampleView&, std::span<float>) const override {}
  Room world_;
  Room learned_;
  Pose2 truth_;
  std::vector<bool> dropped_;
};

const Room kEmpty{{6.0, -5.0, 5.0}};

/// The room with a shorter wall in front.
Room withWall(double x) {
  Room room = kEmpty;
  room.push_back({x, -1.0, 1.0});
  return room;
}

std::vector<NewReading> readingAt(const Room& world, const Room& learned, const Pose2& truth) {
  return {{nullptr, 1, std::make_shared<RoomScan>(world, learned, truth)}};
}

class MapWatchTest : public testing::Test {
 protected:
  /// Passes the wall once, at a speed of 0.5 m/s and then away for a while.
  /// @param off error of the estimates
  void pass(const Room& world, const Room& learned, TrackStatus status = TrackStatus::kTracking,
            const Pose2& off = {}) {
    for (double y = -3.0; y <= 3.0; y += 0.15) {
      const Pose2 truth{0.0, y, 0.0};
      PoseEstimate estimate;
      estimate.stamp = now_ += 300'000;
      estimate.pose = truth * off;
      estimate.covariance = {1e-4, 0, 0, 0, 1e-4, 0, 0, 0, 1e-5};
      estimate.status = status;
      watch_.follow(readingAt(world, learned, truth), estimate);
    }
    now_ += 60 * kSecond;
  }

  std::size_t sure(MapChange::Kind kind) const { return watch_.changes().sure(kind); }
  std::size_t sure() const { return sure(MapChange::Kind::kGone) + sure(MapChange::Kind::kNew); }

  MapWatch watch_;
  Timestamp now_ = 1'700'000'000 * kSecond;
};

TEST_F(MapWatchTest, FindsNothingWhereTheMapFits) {
  for (int k = 0; k < 5; ++k) pass(withWall(3.0), withWall(3.0));
  EXPECT_TRUE(watch_.changes().cells.empty());
}

TEST_F(MapWatchTest, ToleratesSmallErrorsOfThePose) {
  for (int k = 0; k < 5; ++k)
    pass(withWall(3.0), withWall(3.0), TrackStatus::kTracking, {0.03, -0.03, 0.006});
  EXPECT_TRUE(watch_.changes().cells.empty());
}

TEST_F(MapWatchTest, FindsAWallThatWasMovedByHalfAMetreWithinThreePasses) {
  for (int k = 0; k < 3; ++k) pass(withWall(3.5), withWall(3.0));
  std::size_t gone = 0;
  std::size_t fresh = 0;
  for (const MapChange& one : watch_.changes().cells) {
    if (!one.isSure) continue;
    const double x = one.x;
    const double y = one.y;
    const bool isGone = one.kind == MapChange::Kind::kGone;
    ++(isGone ? gone : fresh);
    EXPECT_NEAR(x, isGone ? 3.0 : 3.5, 1e-6);
    EXPECT_LE(std::abs(y), 1.2);
  }
  EXPECT_GE(gone, 15U);  // of 20 cells
  EXPECT_GE(fresh, 15U);
}

TEST_F(MapWatchTest, FindsWhatIsNewInFront) {
  for (int k = 0; k < 3; ++k) pass(withWall(2.5), withWall(3.0));
  std::size_t fresh = 0;
  for (const MapChange& one : watch_.changes().cells) {
    if (!one.isSure) continue;
    // Seen from the sides, the wall behind is gone, too.
    if (one.kind == MapChange::Kind::kGone) continue;
    EXPECT_NEAR(one.x, 2.5, 1e-6);
    ++fresh;
  }
  EXPECT_GE(fresh, 15U);
}

TEST_F(MapWatchTest, IsSureOnlyAfterTwoPasses) {
  pass(withWall(2.0), kEmpty);
  EXPECT_FALSE(watch_.changes().cells.empty());
  EXPECT_EQ(sure(), 0U);
  pass(withWall(2.0), kEmpty);
  EXPECT_GT(sure(), 0U);
}

TEST_F(MapWatchTest, ForgetsWhatIsAsLearnedAgain) {
  for (int k = 0; k < 3; ++k) pass(withWall(2.0), kEmpty);
  ASSERT_GT(sure(MapChange::Kind::kNew), 0U);
  for (int k = 0; k < 2; ++k) pass(kEmpty, kEmpty);
  EXPECT_EQ(sure(), 0U);
  for (const MapChange& one : watch_.changes().cells) {
    EXPECT_GE(one.passes, 1U);
    if (one.against > 0) {
      EXPECT_EQ(one.lately, 0U);
    }
  }
}

TEST_F(MapWatchTest, NoticesThatAWallIsBack) {
  for (int k = 0; k < 3; ++k) pass(kEmpty, withWall(3.0));
  ASSERT_GT(sure(MapChange::Kind::kGone), 0U);
  for (int k = 0; k < 2; ++k) pass(withWall(3.0), withWall(3.0));
  EXPECT_EQ(sure(), 0U);
}

TEST_F(MapWatchTest, LooksOnlyWhileTracking) {
  for (int k = 0; k < 3; ++k) pass(kEmpty, withWall(3.0), TrackStatus::kUncertain);
  EXPECT_TRUE(watch_.changes().cells.empty());
}

TEST_F(MapWatchTest, DoubtsThePlaceIfMostBeamsContradict) {
  const Room far{{9.0, -20.0, 20.0}};
  const Room near{{6.0, -20.0, 20.0}};
  for (int k = 0; k < 3; ++k) pass(far, near);
  EXPECT_TRUE(watch_.changes().cells.empty());
}

TEST_F(MapWatchTest, ForgetsThePassInWhichThePlaceWasAnother) {
  pass(kEmpty, withWall(3.0));
  for (double y = -1.0; y <= 1.0; y += 0.15) {
    const Pose2 truth{0.0, y, 0.0};
    PoseEstimate estimate;
    estimate.stamp = now_ += 300'000;
    estimate.pose = truth;
    estimate.covariance = {1e-4, 0, 0, 0, 1e-4, 0, 0, 0, 1e-5};
    estimate.status = TrackStatus::kTracking;
    watch_.follow(readingAt(kEmpty, withWall(3.0), truth), estimate);
  }
  watch_.forgetPass();
  pass(withWall(3.0), withWall(3.0));
  EXPECT_EQ(sure(), 0U);
}

TEST_F(MapWatchTest, CountsDays) {
  for (int day = 0; day < 3; ++day) {
    for (int k = 0; k < 2; ++k) pass(kEmpty, withWall(3.0));
    now_ += kDay;
  }
  std::uint32_t most = 0;
  for (const MapChange& one : watch_.changes().cells) {
    EXPECT_GE(one.passes, one.days);
    most = std::max(most, one.days);
  }
  EXPECT_EQ(most, 3U);
}

// Many beams of a scan meet a cell near by.
TEST_F(MapWatchTest, OneScanSaysNothing) {
  PoseEstimate estimate;
  estimate.covariance = {1e-4, 0, 0, 0, 1e-4, 0, 0, 0, 1e-5};
  estimate.status = TrackStatus::kTracking;
  for (int k = 0; k < 5; ++k) {
    estimate.stamp = now_ += kSecond;  // the robot stands still
    watch_.follow(readingAt(withWall(1.0), kEmpty, estimate.pose), estimate);
  }
  EXPECT_TRUE(watch_.changes().cells.empty());
}

TEST_F(MapWatchTest, WhatIsOutOfReachIsNotTakenBack) {
  for (int k = 0; k < 3; ++k) pass(withWall(2.0), kEmpty);
  const std::size_t before = sure(MapChange::Kind::kNew);
  ASSERT_GT(before, 0U);
  const Room nothing;
  for (int k = 0; k < 3; ++k) {
    for (double y = -3.0; y <= 3.0; y += 0.15) {  // 13 m away, in an open hall
      const Pose2 truth{-11.0, y, 0.0};
      PoseEstimate estimate;
      estimate.stamp = now_ += 300'000;
      estimate.pose = truth;
      estimate.covariance = {1e-4, 0, 0, 0, 1e-4, 0, 0, 0, 1e-5};
      estimate.status = TrackStatus::kTracking;
      watch_.follow(readingAt(nothing, nothing, truth), estimate);
    }
    now_ += 60 * kSecond;
  }
  EXPECT_EQ(sure(MapChange::Kind::kNew), before);
}

TEST_F(MapWatchTest, LooksWithEachScanner) {
  // Two scanners take turns; between them the robot moves less than a look asks for.
  const auto* front = reinterpret_cast<const SensorData*>(1);
  const auto* rear = reinterpret_cast<const SensorData*>(2);
  for (int k = 0; k < 3; ++k) {
    for (double y = -3.0; y <= 3.0; y += 0.08) {
      const Pose2 truth{0.0, y, 0.0};
      PoseEstimate estimate;
      estimate.stamp = now_ += 100'000;
      estimate.pose = truth;
      estimate.covariance = {1e-4, 0, 0, 0, 1e-4, 0, 0, 0, 1e-5};
      estimate.status = TrackStatus::kTracking;
      const bool isFront = std::lround((y + 3.0) / 0.08) % 2 == 0;
      std::vector<NewReading> news =
          readingAt(withWall(2.0), isFront ? withWall(2.0) : kEmpty, truth);
      news[0].feature = isFront ? front : rear;
      watch_.follow(news, estimate);
    }
    now_ += 60 * kSecond;
  }
  EXPECT_FALSE(watch_.changes().cells.empty());
}

TEST_F(MapWatchTest, ForgetsWhatWasFoundOnce) {
  pass(withWall(2.0), kEmpty);
  ASSERT_FALSE(watch_.changes().cells.empty());
  for (int k = 0; k < 3; ++k) pass(kEmpty, kEmpty);
  for (const MapChange& one : watch_.changes().cells)
    EXPECT_EQ(one.against, 0U) << "only what no beam has passed is left";
}

TEST_F(MapWatchTest, IsRestored) {
  for (int k = 0; k < 3; ++k) pass(withWall(2.0), withWall(3.0));
  const MapChanges kept = watch_.changes();
  ASSERT_GT(kept.sure(MapChange::Kind::kNew), 0U);
  MapWatch other;
  other.restore(kept);
  EXPECT_EQ(other.changes().cells, kept.cells);
}

TEST_F(MapWatchTest, LeavesOutBeamsThatMeetWhatChanged) {
  const Pose2 pose{0.0, 0.0, 0.0};
  const Room world = withWall(3.5);
  const Room learned = withWall(3.0);
  const std::vector<NewReading> news = readingAt(world, learned, pose);
  EXPECT_EQ(watch_.withoutChanged(news, pose)[0].weigher, news[0].weigher);
  for (int k = 0; k < 3; ++k) pass(world, learned);
  const std::vector<NewReading> left = watch_.withoutChanged(news, pose);
  const auto* scan = dynamic_cast<const RoomScan*>(left[0].weigher.get());
  ASSERT_NE(scan, nullptr);
  ASSERT_EQ(scan->dropped().size(), 181U);
  for (int degree = -90; degree <= 90; ++degree) {
    const bool isDropped = scan->dropped()[static_cast<std::size_t>(degree + 90)];
    const double meets = 3.0 * std::tan(std::abs(degree) * std::numbers::pi / 180.0);
    if (meets < 0.8) {
      EXPECT_TRUE(isDropped) << degree;
    }
    if (meets > 1.3) {
      EXPECT_FALSE(isDropped) << degree;
    }
  }
}

TEST(MapChanges, AreChecked) {
  using Kind = MapChange::Kind;
  const auto wrong = [](std::vector<MapChange> cells) {
    try {
      MapChanges{std::move(cells)}.check();
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const MapChange good{Kind::kGone, 1, 2, 0.15, 0.25, 3, 2, 1, 2, 19'000};
  const auto with = [&good](auto change) {
    MapChange other = good;
    change(other);
    return std::vector{other};
  };
  EXPECT_EQ(wrong({}), "");
  EXPECT_EQ(wrong({good}), "");
  EXPECT_EQ(wrong({good, good}), "changed cell 1 does not come after the one before");
  EXPECT_EQ(wrong(with([](MapChange& c) { c.passes = 0; })),
            "changed cell 0 was never found changed");
  EXPECT_EQ(wrong(with([](MapChange& c) { c.lately = 4; })),
            "changed cell 0 has counts that don't fit together");
  EXPECT_EQ(wrong(with([](MapChange& c) { c.days = 4; })),
            "changed cell 0 has counts that don't fit together");
  EXPECT_EQ(wrong(with([](MapChange& c) { c.days = 0; })),
            "changed cell 0 has counts that don't fit together");
  EXPECT_EQ(wrong(with([](MapChange& c) { c.column = 10'000'000; })),
            "changed cell 0 is farther away than 1e6 m");
  EXPECT_EQ(wrong(with([](MapChange& c) { c.row = -10'000'001; })),
            "changed cell 0 is farther away than 1e6 m");
  EXPECT_EQ(wrong(with([](MapChange& c) { c.kind = static_cast<Kind>(2); })),
            "changed cell 0 has no kind of change");
  EXPECT_EQ(wrong(with([](MapChange& c) { c.x = 0.21; })),
            "changed cell 0 has its middle elsewhere");
  EXPECT_EQ(wrong(with([](MapChange& c) { c.y = 0.19; })),
            "changed cell 0 has its middle elsewhere");
  EXPECT_EQ(wrong(with([](MapChange& c) { c.y = std::nan(""); })),
            "changed cell 0 has its middle elsewhere");
  std::vector<MapChange> many(MapChanges::kMost + 1, good);
  EXPECT_EQ(wrong(many), "there are 100001 changed cells, expected at most 100000");
}

}  // namespace
}  // namespace ortung
