// Matches of the scenes that ship, cut short.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "Paths.hpp"
#include "ortung/formats/PlacesData.hpp"
#include "ortung/robot/RobotFile.hpp"
#include "ortung/sim/RunDigest.hpp"
#include "ortung/sim/SceneRun.hpp"

namespace ortung {
namespace {

/// Plays a match and looks at what must hold all the time.
struct Match {
  Match(const std::string& scene, std::uint64_t seed, double seconds)
      : run(Scene::read(ORTUNG_SOURCE_DIR "/maps/scenes/" + scene), {.seed = seed}, factory,
            {.budget = 0.0, .onProblem = [this](const std::string& what) { problems += what; }}) {
    play(seconds);
  }
  void play(double seconds) {
    const auto robots = run.simulation().robots().size();
    const Timestamp end = run.simulation().now() + fromSeconds(seconds);
    while (run.simulation().now() < end) {
      run.step();
      digest.add(run);
      for (const RefereeEvent& event : run.referee()->takeEvents()) {
        ++count[event.what];
        if (event.what == "goal") ++count["goal of " + event.team];
        log += std::to_string(toSeconds(event.stamp)) + " " + event.what + " " + event.team + "\n";
      }
      const auto& bounds = run.simulation().world().solids().bounds;
      for (const auto& robot : run.simulation().robots()) check(robot->state().pose, bounds);
      for (const auto& thing : run.simulation().things()) check(thing.pose, bounds);
    }
    EXPECT_EQ(problems, "");
    EXPECT_EQ(run.simulation().robots().size(), robots);
    EXPECT_EQ(count["problem"], 0) << log;
  }
  void check(const Pose2& pose, const Box2& bounds) {
    isWithin = isWithin && isFinite(pose) && pose.x > bounds.xLow && pose.x < bounds.xHigh &&
               pose.y > bounds.yLow && pose.y < bounds.yHigh;
  }

  std::string problems;
  PluginFactory factory{PluginFactory::standardFolders()};
  SceneRun run;
  RunDigest digest;
  std::map<std::string, int> count;
  std::string log;
  bool isWithin = true;
};

TEST(FootballMatch, OfFourAgainstFourHasGoalsAndGoesOn) {
  Match match("f2000_match.toml", 3, 200.0);
  EXPECT_GE(match.count["goal"], 1) << match.log;
  EXPECT_EQ(match.count["kick-off"], 1 + match.count["goal"]);
  EXPECT_EQ(match.count["set-piece-over"], 0) << match.log;
  EXPECT_LE(match.count["ball-stuck"], 2) << match.log;
  EXPECT_TRUE(match.isWithin);
}

TEST(FootballMatch, TellsARobotOfTheTeamWhereTheOthersAre) {
  Match match("f2000_match.toml", 1, 0.1);
  SceneRun& run = match.run;
  RobotConfig listener = readRobot(ORTUNG_SOURCE_DIR "/maps/robots/pioneer_blind.toml");
  SimRobot& robot = run.addRobot(listener, match.factory, Pose2{-5.0, 3.5, 0.0}, 100);
  run.players().setTeam(robot.config().name, "blue");
  for (int i = 0; i < 1000; ++i) run.step();
  const auto robots = robot.container().get<PlacesData>({.feature = "robots"});
  ASSERT_TRUE(robots);
  EXPECT_EQ(robots->size(), 3u) << "the keeper says nothing";
  for (const PlacesData::Told& told : *robots) {
    const auto place = run.find(told.place.name);
    ASSERT_TRUE(place) << told.place.name;
    const Pose2& truth = run.simulation().robots()[*place]->state().pose;
    EXPECT_LT(distance(told.place.fix.pose, truth), 0.5) << "a tenth of a second ago";
    EXPECT_TRUE(told.place.name.starts_with("blue")) << told.place.name;
  }
  EXPECT_TRUE(robot.container().get<PlacesData>({.feature = "balls"}));
}

TEST(FootballMatch, OfFiveAgainstFiveTakesAllRestarts) {
  Match match("msl_match.toml", 1, 120.0);
  const int given = match.count["kick-off"] + match.count["throw-in"] + match.count["goal-kick"] +
                    match.count["corner"] + match.count["free-kick"];
  EXPECT_GE(given, 5) << match.log;
  EXPECT_EQ(match.count["set-piece-over"], 0) << match.log;
  EXPECT_GE(match.count["play"], given - 1) << match.log;  // the last may be waited for
  EXPECT_EQ(match.count["ball-stuck"], 0) << match.log;
  EXPECT_TRUE(match.isWithin);
}

// Whatever the referee gives, its team takes it before it may not any more, and play goes on.
TEST(FootballMatch, TakesRestartsOfEachKind) {
  for (const char* scene : {"f2000_match.toml", "msl_match.toml"}) {
    Match match(scene, 3, 15.0);
    for (const std::string kind :
         {"kick-off", "throw-in", "goal-kick", "corner", "free-kick", "penalty"})
      for (const std::string team : {"blue", "yellow"}) {
        match.count.clear();
        match.log.clear();
        match.run.referee()->order(kind + " " + team);
        match.play(0.1);
        EXPECT_EQ(match.count[kind], 1) << match.log;
        const auto isOver = [&] { return match.count["play"] + match.count["set-piece-over"] > 0; };
        for (int i = 0; i < 15 && !isOver(); ++i) match.play(1.0);
        EXPECT_TRUE(isOver()) << scene << " " << kind << " " << team << match.log;
        // For a corner out of the blue they may have to come from the other end of the field.
        if (kind != "corner") {
          EXPECT_EQ(match.count["set-piece-over"], 0) << scene << " " << kind << " " << team;
        }
        match.play(2.0);
      }
    match.count.clear();
    match.run.referee()->order("dropped-ball");
    match.play(1.2);
    EXPECT_EQ(match.run.game().phase, Game::Phase::kPlaying);
    EXPECT_EQ(match.count["dropped-ball"], 1);
  }
}

TEST(FootballMatch, IsTheSameAgain) {
  const auto digest = [](std::uint64_t seed) {
    return Match("f2000_match.toml", seed, 20.0).digest.value();
  };
  EXPECT_EQ(digest(7), digest(7));
  EXPECT_NE(digest(7), digest(8));
}

}  // namespace
}  // namespace ortung
