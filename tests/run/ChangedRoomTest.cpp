// A room in which a partition stands that was not learned.
#include <cmath>
#include <functional>

#include "RoomRun.hpp"
#include "ortung/formats/ChangesData.hpp"

namespace ortung::test {
namespace {

constexpr double kPartition = 1.45;  ///< x of a partition [m]; the wall that was learned is at 2
constexpr double kHalf = 0.5;        ///< half its length [m]

class ChangedRoom : public RoomRun {
 protected:
  /// Drives circles of 0.9 m about the middle at 0.1 m/s, so that each lap is a pass of its own.
  void driveLaps(
      Localization& localization, int laps, const std::function<void()>& afterEach = [] {}) {
    constexpr double kStep = 2 * kPi / 120;
    const ScanData::Config scan{
        .beams = 31, .firstAngle = -kPi / 2, .angleStep = kPi / 30, .maxRange = 8.0};
    Pose2 at = start;
    for (int i = 0; i <= 120 * laps; ++i) {
      if (i > 0) at = at * Pose2{0.9 * kStep, 0, kStep};
      const Timestamp now = 500'000 * i;
      std::vector<float> ranges;
      for (int k = 0; k < scan.beams; ++k) {
        const double angle = at.theta + scan.firstAngle + k * scan.angleStep;
        const double wall = room.range(at.x, at.y, angle);
        const double range = std::cos(angle) > 1e-6 ? (kPartition - at.x) / std::cos(angle) : 1e9;
        const bool isMet = std::abs(at.y + range * std::sin(angle)) < kHalf;
        ranges.push_back(static_cast<float>(isMet ? std::min(wall, range) : wall));
      }
      std::vector<std::uint32_t> words;
      ScanData::encode(ranges, scan.maxRange, words);
      localization.container().set(
          std::vector<Message>{{now, {"LMS200", "LRF", "180DegreeScan"}, words},
                               {now,
                                {"odometry", "odometry", "pose"},
                                OdometryData::encode({inverse(start) * at, 0, 0, {}})}});
      localization.update();
      afterEach();
      truth = at;
    }
  }
};

TEST_F(ChangedRoom, IsNoticedWithinThreePassesAndPublished) {
  LocalizationConfig told = config();
  told.publish = true;
  Localization localization(told);
  driveLaps(localization, 3);
  EXPECT_LT(distance(localization.mcl().estimate().pose, truth), 0.1);
  const MapChanges changes = localization.mcl().mapChanges();
  EXPECT_GE(changes.sure(MapChange::Kind::kNew), 7U) << "of 10 cells";
  EXPECT_EQ(changes.sure(MapChange::Kind::kGone), 0U);
  for (const MapChange& one : changes.cells)
    if (one.isSure) {
      EXPECT_NEAR(one.x, kPartition, 0.1);
    }
  const auto published = localization.container().get<ChangesData>({.feature = "map"});
  ASSERT_TRUE(published);
  EXPECT_EQ(published->cells.size(), changes.cells.size());
}

// Who goes to a moment of a record looks back three seconds for what was told.
TEST_F(ChangedRoom, IsToldAgainAndAgainButNotEachTime) {
  LocalizationConfig told = config();
  told.publish = true;
  Localization localization(told);
  std::vector<Timestamp> stamps;
  const auto look = [&] {
    const SensorData* map = localization.container().find({.feature = "map"});
    if (map->sequence() > 0 && (stamps.empty() || map->stamp() != stamps.back()))
      stamps.push_back(map->stamp());
  };
  driveLaps(localization, 3, look);
  ASSERT_GT(stamps.size(), 20U);
  std::size_t repeated = 0;
  for (std::size_t i = 1; i < stamps.size(); ++i) {
    EXPECT_GE(stamps[i] - stamps[i - 1], 1'000'000);
    repeated += stamps[i] - stamps[i - 1] == 2'000'000;
  }
  for (std::size_t i = stamps.size() - 20; i < stamps.size(); ++i)
    EXPECT_LE(stamps[i] - stamps[i - 1], 2'500'000);
  EXPECT_GT(repeated, 5U);
}

TEST_F(ChangedRoom, IsNotWatchedIfNobodyWants) {
  writeBytes(robotFile, readBytes(robotFile) + "watches_map = false\n");
  Localization localization(config());
  driveLaps(localization, 3);
  EXPECT_TRUE(localization.mcl().mapChanges().cells.empty());
}

TEST_F(ChangedRoom, IsNotForgottenWithThePlace) {
  Localization localization(config());
  driveLaps(localization, 3);
  const std::size_t sure = localization.mcl().mapChanges().sure(MapChange::Kind::kNew);
  ASSERT_GT(sure, 0U);
  localization.relocalize();
  EXPECT_EQ(localization.mcl().mapChanges().sure(MapChange::Kind::kNew), sure);
}

}  // namespace
}  // namespace ortung::test
