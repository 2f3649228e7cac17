// Rides of a lift in a building of five floors that differ in doors, some partitions and furniture.
// ORTUNG_LIFT_RIDES says how many rides (500 for the figures in docs/worlds.md).
#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>

#include "Files.hpp"
#include "LiftRide.hpp"
#include "Program.hpp"
#include "ortung/run/Localization.hpp"

namespace ortung::test {
namespace {

using testing::DrawnBuilding;
using testing::kRoundRobot;
using testing::LiftRide;

int rides() {
  const char* const text = std::getenv("ORTUNG_LIFT_RIDES");
  return text != nullptr ? std::atoi(text) : 6;
}

/// Localizes a robot, and compares what is told with where it is.
struct Follower {
  Follower(const LiftRide& itsRobot, Localization& its, const Building& itsBuilding)
      : robot(itsRobot), localization(its), building(itsBuilding) {}

  void operator()(const std::vector<ortung::Message>& moment) {
    localization.take(moment);
    if (!localization.update()) return;
    const PoseEstimate& e = localization.mcl().estimate();
    const bool isRight = building.floorAt(e.pose.x) == robot.floor();
    const bool isTold = e.status == TrackStatus::kTracking;
    if (judges && !isRight && isTold) isEverWrong = true;
    const bool isKnown = e.status != TrackStatus::kLost;
    const std::vector<double> shares = localization.mcl().floorShares();
    if (judges && isKnown && !isRight && shares[building.floorAt(e.pose.x)] > 0.9)
      isEverSettledWrongly = true;
    ++scans;
    if (scans == 3) {
      isRightAtThird = isRight;
      isUnsureAtThird = !isTold;
    }
    if (scans > 0 && robot.isInCorridor() && ++outside == 3) isRightOutside = isRight;
    const Pose2 off = inverse(robot.truth()) * e.pose;
    isFound = std::hypot(off.x, off.y) < 0.5;
    tracks = isTold;
  }
  /// From now on scans count.
  void begin() { scans = 0; }

  const LiftRide& robot;
  Localization& localization;
  const Building& building;
  bool judges = true;                 ///< whether the robot is on one floor
  bool isEverWrong = false;           ///< whether a wrong floor was told as tracked
  bool isEverSettledWrongly = false;  ///< whether nearly all of the belief was on a wrong floor
  int scans = -1'000'000;
  int outside = 0;
  bool isRightAtThird = false, isUnsureAtThird = false, isRightOutside = false;
  bool isFound = false, tracks = false;  ///< by the newest scan
};

/// What became of rides or starts.
struct Figures {
  int runs = 0;
  int rightAtThird = 0;      ///< the right floor by the third scan
  int unsureAtThird = 0;     ///< not the right one by then, and said so
  int rightOutside = 0;      ///< the right floor by the third scan in the corridor
  int foundAtEnd = 0;        ///< within 0.5 m at the end
  int trackedAtEnd = 0;      ///< and told as tracked
  int confidentlyWrong = 0;  ///< runs in which a wrong floor was ever told as tracked
  int settledWrongly = 0;    ///< ... or had ever nearly all of the belief

  void add(const Follower& follow) {
    ++runs;
    rightAtThird += follow.isRightAtThird ? 1 : 0;
    unsureAtThird += !follow.isRightAtThird && follow.isUnsureAtThird ? 1 : 0;
    rightOutside += follow.isRightOutside ? 1 : 0;
    foundAtEnd += follow.isFound ? 1 : 0;
    trackedAtEnd += follow.isFound && follow.tracks ? 1 : 0;
    confidentlyWrong += follow.isEverWrong ? 1 : 0;
    settledWrongly += follow.isEverSettledWrongly ? 1 : 0;
  }
};

class LiftRides : public ::testing::Test {
 protected:
  static constexpr const char* kLift =
      "\n[[lift]]\nname = \"A\"\nposition_m = [15.0, 5.9]\nheading_deg = 90\n";

  void learn(const std::string& toml) {
    writeBytes(folder_ / "building.toml", toml);
    writeBytes(folder_ / "robot.toml", kRoundRobot);
    const Outcome learned =
        ortung({"learn", "--world", folder_ / "building.toml", "--robot", folder_ / "robot.toml",
                "--out", folder_ / "t.ortung", "--force"});
    ASSERT_EQ(learned.exitCode, 0) << learned.err;
    world_ = readWorld(folder_ / "building.toml");
    building_ = world_->region(0.5, {}).building;
  }

  /// Rides from one floor to another, and adds what became of it.
  void ride(std::uint64_t seed, Figures& figures) {
    Random random(seed, 5);
    LiftRide robot(*world_, seed);
    Localization localization(
        {.robot = folder_ / "robot.toml", .tables = folder_ / "t.ortung", .seed = seed});
    const auto from = static_cast<std::size_t>(random.below(5));
    const auto to = static_cast<std::size_t>(random.below(5));
    const double side = random.uniform() < 0.5 ? -1.0 : 1.0;
    robot.standAt(from, {15.0 + side * random.uniform(2.0, 8.0), DrawnBuilding::kCorridor,
                         random.uniform(-3.0, 3.0)});
    localization.start({LocalizationStart::Kind::kPose, robot.truth(), 0.2, 0.1});
    Follower follow(robot, localization, building_);
    robot.driveTo(15.0, DrawnBuilding::kCorridor, follow);
    robot.driveTo(15.0, DrawnBuilding::kLift.y, follow);
    robot.stand(random.uniform(1.0, 4.0), follow);
    robot.closeDoor();
    follow.judges = false;  // nobody says where a cabin is between floors
    const double seconds = random.uniform(5.0, 20.0);
    robot.stand(seconds / 2, follow);
    robot.rideTo(to);
    robot.stand(seconds / 2, follow);
    robot.openDoor();
    follow.judges = true;
    follow.begin();
    robot.stand(1.0, follow);
    robot.driveTo(15.0, DrawnBuilding::kCorridor, follow);
    robot.driveTo(15.0 + side * 6.0, DrawnBuilding::kCorridor, follow);
    figures.add(follow);
  }

  /// Switches the robot on somewhere, and adds what became of it. @param turn how far it turns
  /// [rad]
  void start(std::uint64_t seed, Figures& figures, double turn = 4.0) {
    Random random(seed, 6);
    LiftRide robot(*world_, seed);
    Localization localization(
        {.robot = folder_ / "robot.toml", .tables = folder_ / "t.ortung", .seed = seed});
    const FieldRegion& region = localization.robot().tables.region;
    std::vector<std::size_t> cells;
    for (std::size_t i = 0; i < region.standable.size(); ++i)
      if (region.standable[i] != 0) cells.push_back(i);
    const std::size_t cell = cells[static_cast<std::size_t>(random.below(cells.size()))];
    const std::size_t floor = building_.floorAt(region.grid.centreX(cell));
    robot.standAt(floor, building_.floors[floor].fromField({region.grid.centreX(cell),
                                                            region.grid.centreY(cell),
                                                            random.uniform(-3.0, 3.0)}));
    Follower follow(robot, localization, building_);
    follow.begin();
    robot.turn(turn, follow);
    figures.add(follow);
  }

  /// Does something @p count times, in another building every fifty times.
  template <class Run>
  Figures many(int count, bool twins, const char* more, const Run& run) {
    Figures figures;
    constexpr int kInABuilding = 50;
    for (int i = 0; i < count; ++i) {
      if (i % kInABuilding == 0)
        learn(DrawnBuilding(static_cast<std::uint64_t>(1 + i / kInABuilding), twins).toml() + more);
      run(static_cast<std::uint64_t>(100 + i), figures);
    }
    std::cout << figures.runs << " runs, right by the third scan " << figures.rightAtThird
              << " (else unsure " << figures.unsureAtThird << "), by the third in the corridor "
              << figures.rightOutside << ", found at the end " << figures.foundAtEnd
              << ", tracked then " << figures.trackedAtEnd << ", confidently wrong "
              << figures.confidentlyWrong << ", settled wrongly " << figures.settledWrongly << '\n';
    return figures;
  }
  Figures manyRides(bool twins, const char* lift = kLift) {
    return many(rides(), twins, lift, [this](std::uint64_t seed, Figures& f) { ride(seed, f); });
  }

  TemporaryFolder folder_;
  std::unique_ptr<SimWorld> world_;
  Building building_;
};

TEST_F(LiftRides, EndOnTheRightFloor) {
  const Figures figures = manyRides(false);
  EXPECT_EQ(figures.confidentlyWrong, 0);
  EXPECT_EQ(figures.rightAtThird + figures.unsureAtThird, figures.runs);
  EXPECT_GE(100 * figures.rightOutside, 99 * figures.runs);
  EXPECT_EQ(figures.trackedAtEnd, figures.runs);
}

/// Nothing tells two equal floors apart, so neither may be told as tracked after a ride.
TEST_F(LiftRides, ToOneOfTwoEqualFloorsStayOpen) {
  const Figures figures = manyRides(true);
  EXPECT_EQ(figures.confidentlyWrong, 0);
}

/// A lift that the world file leaves out carries the robot away: it is found again.
TEST_F(LiftRides, ThatNobodyToldOfAreNoticed) {
  const Figures figures = manyRides(false, "");
  EXPECT_EQ(figures.confidentlyWrong, 0);
}

/// Between equal floors samples gather on one of them by chance; no floor is theirs for that.
TEST_F(LiftRides, AreNotNeededToLeaveTwoEqualFloorsOpenAtTheStart) {
  const Figures figures = many(2 * rides(), true, kLift,
                               [this](std::uint64_t seed, Figures& f) { start(seed, f, 40.0); });
  EXPECT_EQ(figures.confidentlyWrong, 0);
  EXPECT_EQ(figures.settledWrongly, 0);
}

TEST_F(LiftRides, AreNotNeededToFindTheFloorAtTheStart) {
  const Figures figures =
      many(rides(), false, kLift, [this](std::uint64_t seed, Figures& f) { start(seed, f); });
  EXPECT_EQ(figures.confidentlyWrong, 0);
}

}  // namespace
}  // namespace ortung::test
