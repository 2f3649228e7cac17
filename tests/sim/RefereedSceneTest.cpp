// A referee of a scene: players and robots do as it says.
#include <gtest/gtest.h>

#include <algorithm>

#include "Paths.hpp"
#include "WorldFiles.hpp"
#include "ortung/sim/Scene.hpp"
#include "ortung/sim/SceneRun.hpp"

namespace ortung {
namespace {

/// Two robots wander, and once play is on the ball rolls into the goal at positive x.
Scene scene(const test::TemporaryFolder& folder, const std::string& referee) {
  const std::string maps = ORTUNG_SOURCE_DIR "/maps/";
  const std::string player =
      "[[player]]\nplugin = \"wander\"\nrobot = \"" + maps + "robots/pioneer.toml\"\n";
  return Scene::read(folder.write(
      "s.toml", "[scene]\nworld = \"" + maps + "fields/f2000.toml\"\n" + referee + player +
                    "name = \"anna\"\nteam = \"blue\"\nstart = { x_m = -3, y_m = 2 }\n" + player +
                    "name = \"bert\"\nteam = \"yellow\"\nstart = { x_m = 3, y_m = -3 }\n"
                    "[[thing]]\nat_s = 20\nname = \"ball\"\npose = { x_m = 4.8, y_m = 0 }\n"
                    "velocity_m_s = [4, 0]\n"));
}

TEST(RefereedScene, HoldsRobotsUntilTheKickOffAndCountsGoals) {
  const test::TemporaryFolder folder;
  PluginFactory factory(PluginFactory::standardFolders());
  SceneRun run(scene(folder, "[referee]\nplugin = \"soccer\"\n"), {.noise = false}, factory);
  ASSERT_NE(run.referee(), nullptr);
  std::vector<std::string> events;
  bool wasHeld = false;
  const auto play = [&](double seconds) {
    while (run.simulation().now() < fromSeconds(seconds)) {
      run.step();
      for (const RefereeEvent& event : run.referee()->takeEvents())
        events.push_back(event.what + " " + event.team);
      for (const auto& robot : run.simulation().robots()) {
        if (!robot->isHeld()) continue;
        wasHeld = true;
        EXPECT_FALSE(run.game().mayPlay(run.players().teamOf(robot->config().name)));
      }
    }
  };
  play(0.5);
  EXPECT_TRUE(wasHeld);
  EXPECT_EQ(run.game().half, 1);
  play(30.0);
  EXPECT_EQ(run.game().teams[0].score, 1);
  EXPECT_EQ(run.game().teams[1].score, 0);
  EXPECT_NE(std::find(events.begin(), events.end(), "goal blue"), events.end());
  EXPECT_NE(std::find(events.begin(), events.end(), "kick-off yellow"), events.end());
}

TEST(RefereedScene, WithoutARefereeEverybodyPlays) {
  const test::TemporaryFolder folder;
  PluginFactory factory(PluginFactory::standardFolders());
  SceneRun run(scene(folder, ""), {.noise = false}, factory);
  for (int i = 0; i < 100; ++i) run.step();
  EXPECT_EQ(run.referee(), nullptr);
  EXPECT_EQ(run.game().phase, Game::Phase::kFree);
  EXPECT_FALSE(run.simulation().robots()[0]->isHeld());
}

TEST(RefereedScene, WhatIsWrongWithTheRefereeIsSaid) {
  const test::TemporaryFolder folder;
  PluginFactory factory(PluginFactory::standardFolders());
  for (const auto& [referee, why] : std::vector<std::pair<std::string, std::string>>{
           {"[referee]\nplugin = \"nobody\"\n", "nobody"},
           {"[referee]\nplugin = \"soccer\"\nleague = \"msl\"\n", "league"},
           {"[referee]\nplugin = \"soccer\"\noptions = { leage = \"msl\" }\n", "leage"},
           {"[referee]\nplugin = \"soccer\"\noptions = { rules = \"none.toml\" }\n",
            "none.toml"}}) {
    SCOPED_TRACE(referee);
    try {
      SceneRun(scene(folder, referee), {}, factory);
      ADD_FAILURE() << "was taken";
    } catch (const std::exception& error) {
      EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
    }
  }
  EXPECT_EQ(parseReferee("soccer:league=msl").options.text("league"), "msl");
  for (const char* text : {"soccer@blue", "soccer:name=x", "", "soccer:robot=r.toml"})
    EXPECT_THROW(parseReferee(text), ConfigError) << text;
}

}  // namespace
}  // namespace ortung
