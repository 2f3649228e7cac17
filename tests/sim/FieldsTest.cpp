// The worlds that ship with the project, and the maps of real buildings where they are at hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <numeric>

#include "Paths.hpp"
#include "WorldFiles.hpp"

namespace ortung::test {
namespace {

std::unique_ptr<SimWorld> field(const std::string& name) {
  return readWorld(std::filesystem::path(ORTUNG_SOURCE_DIR "/maps/fields") / (name + ".toml"));
}

const Landmark* find(const SimWorld& world, const std::string& kind, std::uint32_t identity) {
  for (const Landmark& mark : world.landmarks())
    if (mark.kind == kind && mark.identity == identity) return &mark;
  return nullptr;
}

TEST(Fields, AllLoadAndCanBeDrivenOn) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(ORTUNG_SOURCE_DIR "/maps/fields")) {
    const auto world = readWorld(entry.path());
    EXPECT_EQ(world->name(), entry.path().stem());
    EXPECT_NO_THROW(world->region(0.1, {0.25}).check()) << entry.path();
    ++count;
  }
  EXPECT_EQ(count, 7);
}

TEST(Fields, F2000HasPostsAndGoalsWhereTheRulesPutThem) {
  const auto world = field("f2000");
  ASSERT_EQ(world->landmarks().size(), 6u);
  for (std::uint32_t i = 1; i <= 4; ++i) {
    const Landmark* post = find(*world, "post", i);
    ASSERT_NE(post, nullptr);
    EXPECT_DOUBLE_EQ(std::abs(post->x), 6.5);
    EXPECT_DOUBLE_EQ(std::abs(post->y), 4.5);
    EXPECT_DOUBLE_EQ(post->z, 0.5);
    EXPECT_TRUE(world->isVisible(0, 0, 0.4, post->x, post->y, post->z, 0, 0.15)) << i;
  }
  EXPECT_DOUBLE_EQ(find(*world, "goal", 1)->x, -6);
  EXPECT_DOUBLE_EQ(find(*world, "goal", 2)->x, 6);
  EXPECT_NEAR(rangeAt(*world, 0, 0, 0), 6.5, 1e-5);                   // the back of the goal
  EXPECT_NEAR(rangeAt(*world, 0, 2, 0), 7, 1e-5);                     // the wall beside it
  EXPECT_NEAR(rangeAt(*world, 0, 0, std::numbers::pi / 2), 5, 1e-5);  // the wall
  EXPECT_EQ(rangeAt(*world, 0, 2, 0, 0.6, 8), 8.0);                   // over the wall
}

TEST(Fields, Soccer18x12HasWallsAtItsLines) {
  const auto world = field("soccer18x12");
  EXPECT_NEAR(rangeAt(*world, 0, 0, std::numbers::pi / 2), 6, 1e-5);
  EXPECT_NEAR(rangeAt(*world, 0, 3, 0), 9, 1e-5);
  EXPECT_NEAR(rangeAt(*world, 0, 0, 0), 9.5, 1e-5);
  EXPECT_FALSE(world->isFree(9.2, 0, {0.1}));
}

TEST(Fields, MslIsSeenOverItsBarrier) {
  const auto world = field("msl");
  EXPECT_NEAR(rangeAt(*world, 0, 0, std::numbers::pi / 2, 0.2), 8, 1e-5);
  EXPECT_EQ(rangeAt(*world, 0, 0, std::numbers::pi / 2, 0.4), 50.0);
  EXPECT_NEAR(rangeAt(*world, 0, 0, 0, 0.4), 11.75 - 0.015, 1e-5);  // the net
  EXPECT_TRUE(world->isFree(11.3, 0, {0.2}));
}

TEST(SharedMaps, AllLoadWithRoomToStand) {
  const std::filesystem::path data = ORTUNG_SHARED_DATA;
  if (!std::filesystem::exists(data)) GTEST_SKIP() << "the shared logs are not at " << data;
  int count = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(data)) {
    if (entry.path().extension() != ".yaml") continue;
    const TemporaryFolder folder;
    const auto start = std::chrono::steady_clock::now();
    const auto world = readWorld(folder.write("world.toml", gridWorld(entry.path().string())));
    const std::chrono::duration<double> read = std::chrono::steady_clock::now() - start;
    const FieldRegion region = world->region(0.1, {0.2});
    const std::chrono::duration<double> all = std::chrono::steady_clock::now() - start;
    const auto standable = std::accumulate(region.standable.begin(), region.standable.end(), 0);
    const auto open = std::accumulate(region.open.begin(), region.open.end(), 0);
    EXPECT_GT(standable, 1000) << entry.path();
    std::cout << entry.path().parent_path().filename().string() << ": " << read.count()
              << " s to read, " << (all - read).count() << " s for the region; "
              << region.grid.size() << " cells, " << open << " open, " << standable
              << " standable\n";
    ++count;
  }
  EXPECT_GE(count, 1);
}

// The grid map of MRPT's own demo, against the picture that was made of it in the same place.
TEST(SharedMaps, MrptsGridMapIsThatOfItsPicture) {
  const std::filesystem::path data = std::filesystem::path(ORTUNG_SHARED_DATA) / "mrpt_uwb_ro";
  const auto gridmap = data / "raw" / "uwb_ro-localization_demo_map.gridmap.gz";
  if (!std::filesystem::exists(gridmap)) GTEST_SKIP() << "there is no " << gridmap;
  const auto reader = std::filesystem::path(ORTUNG_PROGRAM).parent_path() / "ortung-mrpt-reader";
  if (!std::filesystem::exists(reader)) GTEST_SKIP() << reader << " was not built";
  const TemporaryFolder folder;
  const auto read = [&](const std::filesystem::path& map) {
    const auto file = folder.write("world.toml", "[world]\nx_m = [-9, 9]\ny_m = [-9, 9]\n" +
                                                     gridWorld(map, "unknown_margin_m = 0\n"));
    return readWorld(file)->region(0.04, {0}).open;
  };
  const auto fromMrpt = read(gridmap);
  const auto fromPicture = read(data / "map.yaml");
  ASSERT_EQ(fromMrpt.size(), fromPicture.size());
  std::size_t open = 0;
  std::size_t missing = 0;
  std::size_t more = 0;
  for (std::size_t i = 0; i < fromMrpt.size(); ++i) {
    open += fromPicture[i];
    missing += fromPicture[i] > fromMrpt[i] ? 1 : 0;
    more += fromMrpt[i] > fromPicture[i] ? 1 : 0;
  }
  EXPECT_GT(open, 10000u);
  EXPECT_EQ(missing, 0u);
  EXPECT_LT(more, open / 5);  // the picture's threshold of free cells is the stricter one
}

}  // namespace
}  // namespace ortung::test
