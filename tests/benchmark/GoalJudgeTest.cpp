#include <gtest/gtest.h>

#include <cmath>

#include "ortung/benchmark/GoalJudge.hpp"
#include "ortung/core/ShippedFiles.hpp"
#include "ortung/robot/RobotFile.hpp"

namespace ortung {
namespace {

/// A ball rolls at a keeper that stands across before the goal, nobody moves it.
struct Chance {
  explicit Chance(double keeperY)
      : factory(PluginFactory::standardFolders()),
        simulation(readWorld(shippedFile("fields", "f2000.toml")), {.seed = 1}) {
    keeper = &simulation.addRobot(readRobot(shippedFile("robots", "goalkeeper.toml")), factory,
                                  {-5.5, keeperY, std::acos(0.0)});
  }
  GoalOutcome roll(const Pose2& from, double vx, double vy) {
    simulation.placeThing(0, from, {vx, vy, 0.0});
    GoalJudge judge;
    while (simulation.now() < 10'000'000) {
      simulation.step();
      if (judge.sees(simulation.things()[0], *keeper, simulation.cycle())) break;
    }
    return judge.outcome();
  }
  PluginFactory factory;
  Simulation simulation;
  SimRobot* keeper = nullptr;
};

TEST(GoalJudge, TellsGoalsSavesAndMisses) {
  EXPECT_EQ(Chance(-0.6).roll({-3.0, 0.5, 0.0}, -3.0, 0.0), GoalOutcome::kGoal);
  EXPECT_EQ(Chance(0.5).roll({-3.0, 0.5, 0.0}, -3.0, 0.0), GoalOutcome::kSaved);
  EXPECT_EQ(Chance(0.5).roll({-3.0, 2.0, 0.0}, -3.0, 0.0), GoalOutcome::kOut);
  EXPECT_EQ(Chance(0.5).roll({-1.0, 0.5, 0.0}, -1.2, 0.0), GoalOutcome::kOut) << "it stops before";
  EXPECT_EQ(Chance(0.5).roll({-3.0, 0.5, 0.0}, 0.0, 0.0), GoalOutcome::kTime) << "nobody shoots";
}

// The keeper's body is 0.45 m wide and the circle around it 0.64 m: who passes its corner within
// the circle, 3 cm from the body, and misses the goal was not saved.
TEST(GoalJudge, AKeeperSavesWithItsBody) {
  EXPECT_EQ(Chance(1.2).roll({-3.0, 1.2 + 0.225 + 0.11 + 0.03, 0.0}, -3.0, 0.0), GoalOutcome::kOut);
  // What touches it on its way past the post is.
  EXPECT_EQ(Chance(0.8).roll({-3.0, 0.8 + 0.225 + 0.05, 0.0}, -3.0, 0.0), GoalOutcome::kSaved);
}

}  // namespace
}  // namespace ortung
