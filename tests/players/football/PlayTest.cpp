// Single footballers in the simulator.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "TeamTalk.hpp"
#include "ortung/core/ShippedFiles.hpp"
#include "ortung/formats/PlacesData.hpp"
#include "ortung/sim/PlayerWish.hpp"
#include "ortung/sim/SceneRun.hpp"
#include "ortung/sim_api/Referee.hpp"

namespace ortung {
namespace {

/// Some players on a field without referee.
struct Playing {
  explicit Playing(const std::string& field) : run(scene(field), {.seed = 3}, factory, control()) {}
  static Scene scene(const std::string& field) {
    Scene scene;
    scene.world = shippedFile("fields", field);
    return scene;
  }
  PlayerControl::Config control() {
    return {.budget = 0.0, .onProblem = [this](const std::string& what) { problem += what; }};
  }
  SimRobot& add(const std::string& wish) { return run.addPlayer(parsePlayer(wish), ++number); }
  Pose2 ball() { return run.simulation().things()[0].pose; }
  void put(double x, double y, double vx = 0.0, double vy = 0.0) {
    run.simulation().placeThing(0, {x, y, 0.0}, {vx, vy, 0.0});
  }
  /// Until something has come about; whether it has.
  template <class Done>
  bool until(double seconds, const Done& done) {
    const Timestamp end = run.simulation().now() + fromSeconds(seconds);
    while (!done() && run.simulation().now() < end && problem.empty()) run.step();
    EXPECT_EQ(problem, "");
    return done();
  }

  std::string problem;
  std::uint64_t number = 0;
  PluginFactory factory{PluginFactory::standardFolders()};
  SceneRun run;
};

/// In the mouth of the goal at positive x of f2000.
bool isIn(const Pose2& ball) { return ball.x > 6.11 && std::abs(ball.y) < 1.0; }

TEST(Footballer, FetchesABallFromAnySideAndShootsItIntoTheGoal) {
  for (const char* start : {"-1,0,0", "3,0.5,180", "2,-2,90", "5,2,-90"})
    for (const std::string sees : {"truth", "features&stage=no"}) {
      Playing playing("f2000.toml");
      playing.put(1.5, 0.0);
      playing.add("footballer:start=" + std::string(start) + "&sees=" + sees + "@blue");
      EXPECT_TRUE(playing.until(25.0, [&] { return isIn(playing.ball()); })) << start << sees;
    }
}

TEST(Footballer, OnThreeWheelsDoesSo) {
  for (const char* start : {"-1,0,0", "3,0.5,180", "-3,-4,90"})
    for (const std::string sees : {"truth", "features&stage=no"}) {
      Playing playing("msl.toml");
      playing.put(1.5, -1.0);
      playing.add("footballer:robot=msl_omni.toml&start=" + std::string(start) + "&sees=" + sees +
                  "@blue");
      EXPECT_TRUE(playing.until(
          25.0, [&] { return playing.ball().x > 11.11 && std::abs(playing.ball().y) < 1.2; }))
          << start << sees;
    }
}

TEST(Footballer, OfTheOtherTeamShootsAtTheOtherGoal) {
  Playing playing("f2000.toml");
  playing.put(0.0, 1.0);
  playing.add("footballer:start=1,0,0@yellow");
  EXPECT_TRUE(playing.until(
      25.0, [&] { return playing.ball().x < -6.11 && std::abs(playing.ball().y) < 1.0; }));
}

// It sees them itself, too.
TEST(Footballer, GoesRoundRobotsThatStandInItsWay) {
  for (const std::string sees : {"truth", "features&stage=no"}) {
    Playing playing("f2000.toml");
    playing.put(2.0, 0.0);
    const SimRobot& robot = playing.add("footballer:start=-4,0,0&sees=" + sees + "@blue");
    const SimRobot& one = playing.add("goalkeeper:policy=still&name=one&start=-2,0.1,0@yellow");
    const SimRobot& two = playing.add("goalkeeper:policy=still&name=two&start=0,-0.3,0@yellow");
    EXPECT_TRUE(playing.until(30.0, [&] { return isIn(playing.ball()); })) << sees;
    EXPECT_GT(robot.state().pose.x, 0.5) << sees;
    EXPECT_LT(distance(one.state().pose, {-2.0, 0.1, 0.0}), 0.02) << "pushed, " << sees;
    EXPECT_LT(distance(two.state().pose, {0.0, -0.3, 0.0}), 0.02) << "pushed, " << sees;
  }
}

// Where the paths of balls end that nobody has fetched: on the line behind it, at a post, before
// it.
TEST(Goalkeeper, ComesOutForABallThatLiesNearItsGoalAndPushesItAway) {
  const std::pair<double, double> places[] = {
      {-5.9, 0.0}, {-5.95, 0.7}, {-5.92, -0.85}, {-5.4, 0.9}, {-4.8, -0.3}};
  for (const auto& [x, y] : places) {
    Playing playing("f2000.toml");
    playing.put(x, y);
    playing.add("goalkeeper:comes_out_m=1.6&start=-5.5,0.0,90@blue");
    double deepest = 0.0;
    const bool isAway = playing.until(10.0, [&] {
      deepest = std::min(deepest, playing.ball().x);
      return distance(playing.ball(), {-6.0, 0.0, 0.0}) > 1.6;
    });
    EXPECT_TRUE(isAway) << x << " " << y;
    EXPECT_GT(deepest, -6.1) << "all of the ball was not behind the line, " << x << " " << y;
  }
  Playing playing("f2000.toml");
  playing.put(-5.9, 0.0);
  playing.add("goalkeeper:start=-5.5,0.0,90@blue");
  playing.until(5.0, [] { return false; });
  EXPECT_LT(distance(playing.ball(), {-5.9, 0.0, 0.0}), 0.01) << "only if it is told to";
}

TEST(Goalkeeper, DefendsTheOtherGoalAfterHalfTime) {
  PluginFactory factory(PluginFactory::standardFolders());
  Scene scene = Playing::scene("f2000.toml");
  scene.referee = parseReferee("soccer:league=f2000");
  SceneRun run(scene, {.seed = 1}, factory, {.budget = 0.0});
  const SimRobot& blue = run.addPlayer(parsePlayer("goalkeeper:name=b&comes_out_m=1@blue"), 1);
  const SimRobot& yellow = run.addPlayer(parsePlayer("goalkeeper:name=y@yellow"), 2);
  const auto play = [&](double seconds) {
    const Timestamp end = run.simulation().now() + fromSeconds(seconds);
    while (run.simulation().now() < end) run.step();
  };
  for (const double side : {-1.0, 1.0}) {
    play(25.0);
    // Its line is 0.5 m before the goal at 6 m; it steers back from 0.4 m off.
    EXPECT_NEAR(blue.state().pose.x, 5.5 * side, 0.45);
    EXPECT_NEAR(yellow.state().pose.x, -5.5 * side, 0.45);
    run.referee()->order("second-half");
  }
}

TEST(Footballer, OfTwoOneGoesForTheBallAndTheOtherCovers) {
  for (const std::string sees : {"truth", "features&stage=no"}) {
    Playing playing("f2000.toml");
    playing.put(-1.0, 2.0);
    const SimRobot& near = playing.add("footballer:name=near&start=-2,2,0&sees=" + sees + "@blue");
    const SimRobot& far = playing.add("footballer:name=far&start=-4,-2,0&sees=" + sees + "@blue");
    playing.until(2.5, [] { return false; });
    EXPECT_LT(distance(near.state().pose, playing.ball()), 1.0) << sees;
    EXPECT_GT(distance(far.state().pose, playing.ball()), 1.0) << sees;
    EXPECT_LT(far.state().pose.x, playing.ball().x) << sees;
  }
}

/// What a footballer that is alone on a field tells its team, by time.
struct Told {
  std::vector<double> costs;  ///< [s]
  std::vector<Place> places;  ///< of itself
};

Told toldBy(const std::string& sees, double seconds) {
  Playing playing("f2000.toml");
  playing.put(3.0, 0.0);
  playing.run.players().join("ear", "blue");
  const SimRobot& robot = playing.add("footballer:name=only&start=-3,1,0&sees=" + sees + "@blue");
  Told told;
  playing.until(seconds, [&] {
    for (const Heard& heard : playing.run.players().takeHeard("ear")) {
      if (const auto word = football::Word::parse(heard.text, 0.3))
        told.costs.push_back(word->cost);
      const auto place = placeIn(heard.text);
      if (!place || place->kind != Place::Kind::kRobot) continue;
      told.places.push_back(*place);
      EXPECT_LT(distance(place->fix.pose, robot.state().pose), 0.05);
    }
    return false;
  });
  return told;
}

// It covers at first. With the ball in its sight it attacks, which makes it count as half a second
// nearer; within the 0.1 s between two words it hardly gets nearer itself.
TEST(Footballer, WhoAttacksCountsAsNearerByHalfASecond) {
  const Told told = toldBy("truth", 0.35);
  ASSERT_GE(told.costs.size(), 3u);
  EXPECT_NEAR(told.costs[0] - told.costs[1], 0.5, 0.15);
  EXPECT_NEAR(told.costs[1] - told.costs[2], 0.0, 0.15);
}

TEST(Footballer, TellsItsPlaceAndHowWellItIsKnown) {
  const Told told = toldBy("features&stage=no", 0.5);
  ASSERT_GE(told.places.size(), 3u);
  for (const Place& place : told.places) {
    EXPECT_EQ(place.name, "only");
    EXPECT_TRUE(place.hasHeading());
    const auto& c = place.fix.covariance;  // 0.05 m and 0.05 rad, independent of each other
    for (const std::size_t i : {0u, 4u, 8u}) EXPECT_NEAR(std::sqrt(c.at(i)), 0.05, 1e-3) << i;
    for (const std::size_t i : {1u, 2u, 5u}) EXPECT_EQ(c.at(i), 0.0) << i;
  }
}

TEST(Footballer, SaysWhatIsWrong) {
  const auto why = [](const std::string& options) -> std::string {
    try {
      Playing playing("f2000.toml");
      playing.add("footballer:" + options + "@blue");
      playing.run.step();
      return playing.problem;
    } catch (const std::exception& error) {
      return error.what();
    }
  };
  EXPECT_NE(why("sees=all").find("must be one of: truth, features, localized"), std::string::npos);
  EXPECT_NE(why("aim_noise_deg=-1").find("aim_noise_deg"), std::string::npos);
  EXPECT_NE(why("stage=no").find("needs the world's state"), std::string::npos);
  EXPECT_NE(why("sees=features&robot=sonar_ring.toml").find("no sensor with a feature 'ball'"),
            std::string::npos);
  Playing nowhere("arena.toml");
  try {
    nowhere.add("footballer:robot=pioneer.toml&name=a");
    nowhere.run.step();
  } catch (const std::exception& error) {
    nowhere.problem = error.what();
  }
  EXPECT_NE(nowhere.problem.find("length_m"), std::string::npos) << nowhere.problem;
}

}  // namespace
}  // namespace ortung
