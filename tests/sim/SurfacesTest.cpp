#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "WorldFiles.hpp"

// Where rays end: behind the outlines of maps, and at bodies around which one stands.
namespace ortung::test {
namespace {

TEST(Surfaces, OfMapsLieBehindTheirOutlineAsSeenAlongTheRay) {
  // The right half of 20 x 20 cells of 0.5 m is wall: its outline is at x = 5, its surface one cell
  // behind.
  const TemporaryFolder folder;
  std::vector<std::string> rows(20, std::string(10, '.') + std::string(10, '#'));
  folder.write("map.pgm", pgmOf(rows));
  folder.write("map.yaml", mapYaml());
  const auto world =
      readWorld(folder.write("world.toml", gridWorld("map.yaml", "surface_depth_cells = 1\n")));
  for (const double degrees : {0.0, 20.0, -45.0, 55.0}) {
    const double angle = degrees * std::numbers::pi / 180.0;
    EXPECT_NEAR(rangeAt(*world, 3.0, 5.0, angle), (2.0 + 0.5) / std::cos(angle), 1e-3) << degrees;
  }
  // Nearly along the wall at most two depths count.
  const double flat = 70.0 * std::numbers::pi / 180.0;
  EXPECT_NEAR(rangeAt(*world, 4.0, 5.0, flat), 1.0 / std::cos(flat) + 1.0, 1e-3);
}

TEST(Surfaces, OfABodyAreSeenInAllBeamsFromWithinTheCircleAroundIt) {
  const auto world = worldOf("[[rectangle]]\ncenter_m = [90, 9]\nsize_m = [1, 1]\n");
  Primitive bar;
  bar.halfX = 2.0;
  bar.halfY = 0.1;
  world->addBody({.kind = "robot", .name = {}, .colour = {}, .pieces = {bar}}, {0.0, 0.0, 0.0});
  constexpr double y = 0.5;  // beside the bar, within 2 m of its middle
  constexpr int kBeams = 720;
  for (const double x : {0.0, 1.0, -1.5}) {
    std::vector<float> ranges(kBeams);
    world->castFan({.x = x,
                    .y = y,
                    .z = 0.3,
                    .firstAngle = -3.0,
                    .angleStep = 2.0 * std::numbers::pi / kBeams,
                    .maxRange = 50.0},
                   0, ranges);
    int seen = 0;
    for (int i = 0; i < kBeams; ++i) {
      const double angle = -3.0 + 2.0 * std::numbers::pi * i / kBeams;
      // In closed form: its upper side, which lies 0.4 m below.
      const double at = x - 0.4 / std::tan(angle);
      const bool hits = std::sin(angle) < 0.0 && std::abs(at) < 2.0;
      if (std::abs(std::abs(at) - 2.0) < 1e-3) continue;
      EXPECT_NEAR(ranges[static_cast<std::size_t>(i)], hits ? 0.4 / -std::sin(angle) : 50.0, 1e-3)
          << x << " " << i;
      seen += hits ? 1 : 0;
    }
    EXPECT_GT(seen, 200);
  }
}

}  // namespace
}  // namespace ortung::test
