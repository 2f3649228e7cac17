#include <gtest/gtest.h>

#include <array>
#include <optional>
#include <vector>

#include "WorldFiles.hpp"
#include "ortung/core/ShippedFiles.hpp"
#include "ortung/sim/Simulation.hpp"

namespace ortung {
namespace {

std::vector<float> look(const SimWorld& world) {
  std::vector<float> ranges(360);
  world.castFan(
      {.x = 1.0, .y = 0.5, .z = 0.3, .firstAngle = 0.0, .angleStep = 0.0175, .maxRange = 20.0}, 0,
      ranges);
  return ranges;
}

TEST(AnotherWorld, StandsOnTheSameGroundAndNothingMovesInIt) {
  auto first = readWorld(shippedFile("fields", "f2000.toml"));
  const std::vector<float> empty = look(*first);
  Primitive piece;
  piece.halfX = piece.halfY = 0.3;
  piece.zHigh = 1.0;
  const RobotNumber body = first->addBody({"robot", "one", "", {piece}}, {3.0, 0.5, 0.0});
  const std::vector<float> blocked = look(*first);
  ASSERT_NE(empty, blocked);

  const auto second = first->another();
  EXPECT_EQ(look(*second), empty);
  EXPECT_EQ(second->objects().size() + 1, first->objects().size());
  EXPECT_EQ(second->fingerprint(), first->fingerprint());
  EXPECT_EQ(second->name(), first->name());
  // Numbers begin anew, as sensors' random numbers must not depend on who was there before.
  EXPECT_EQ(second->addBody({"robot", "two", "", {piece}}, {-3.0, 0.0, 0.0}), body);
  EXPECT_EQ(look(*first), blocked);

  first.reset();  // what stands lives as long as somebody stands on it
  EXPECT_NE(look(*second), blocked);
  EXPECT_FALSE(second->isFree(6.55, 0.0, {.radius = 0.1, .height = 0.5}));
}

TEST(AnotherWorld, PlaysTheSameToTheBit) {
  const auto play = [](std::unique_ptr<SimWorld> world) {
    Simulation simulation(std::move(world), {});
    simulation.placeThing(0, {2.0, 1.0, 0.0}, {5.0, -2.0, 0.0});
    for (int i = 0; i < 300; ++i) simulation.step();
    const Pose2 ball = simulation.things().front().pose;
    return std::array{ball.x, ball.y, ball.theta};
  };
  const auto ground = readWorld(shippedFile("fields", "f2000.toml"));
  const auto alone = play(readWorld(shippedFile("fields", "f2000.toml")));
  EXPECT_EQ(play(ground->another()), alone);
  EXPECT_EQ(play(ground->another()), alone);
}

}  // namespace
}  // namespace ortung
