#include <gtest/gtest.h>

#include <cmath>

#include "WorldFiles.hpp"
#include "ortung/sim/PlayerWish.hpp"
#include "ortung/sim/Scene.hpp"
#include "ortung/sim/SceneRun.hpp"

namespace ortung {
namespace {

const std::string kExpected = ", expected PLUGIN[:key=value&key=value...][@TEAM]";

std::string refusalOf(const std::string& text) {
  try {
    parsePlayer(text);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

TEST(PlayerWish, IsReadFromAText) {
  const PlayerWish bare = parsePlayer("wander");
  EXPECT_EQ(bare.plugin, "wander");
  EXPECT_EQ(bare.team, "");
  EXPECT_TRUE(bare.seesStage);
  EXPECT_FALSE(bare.start);
  const PlayerWish wish = parsePlayer(
      "keeper:policy=blocking&robot=a@b/r.toml&speed_m_s=-0.5e0&start=1,-2,90&name=anna&stage=no&"
      "way=1,2,3&loud=yes&empty=@blue");
  EXPECT_EQ(wish.plugin, "keeper");
  EXPECT_EQ(wish.team, "blue");
  EXPECT_EQ(wish.robot, "a@b/r.toml");
  EXPECT_EQ(wish.name, "anna");
  EXPECT_FALSE(wish.seesStage);
  ASSERT_TRUE(wish.start);
  EXPECT_EQ(wish.start->x, 1.0);
  EXPECT_NEAR(wish.start->theta, std::acos(0.0), 1e-12);
  EXPECT_EQ(wish.options.text("policy"), "blocking");
  EXPECT_EQ(wish.options.number("speed_m_s"), -0.5);
  EXPECT_EQ(wish.options.numbers("way"), (std::vector<double>{1, 2, 3}));
  EXPECT_TRUE(wish.options.flagOr("loud", false));
  EXPECT_EQ(wish.options.text("empty"), "");
  EXPECT_NO_THROW(wish.options.refuseUnread());
}

// What is the wish's own is no option of the plugin's, and each of it is given once, with a value.
TEST(PlayerWish, KeepsItsOwnKeysFromThePlugin) {
  const std::pair<std::string, std::string> keys[] = {{"robot", "r.toml"},
                                                      {"tables", "t.tables"},
                                                      {"name", "anna"},
                                                      {"start", "1,2,3"},
                                                      {"stage", "no"}};
  for (const auto& [key, value] : keys) {
    SCOPED_TRACE(key);
    const std::string text = "keeper:" + key + "=" + value;
    const PlayerWish wish = parsePlayer(text);
    EXPECT_FALSE(wish.options.has(key));
    EXPECT_EQ(wish.robot, key == "robot" ? value : "");
    EXPECT_EQ(wish.tables, key == "tables" ? value : "");
    EXPECT_EQ(wish.name, key == "name" ? value : "");
    EXPECT_EQ(wish.start.has_value(), key == "start");
    EXPECT_EQ(wish.seesStage, key != "stage");
    EXPECT_EQ(refusalOf("keeper:" + key + "="),
              "player 'keeper:" + key + "=': " + key + " is empty" + kExpected);
    EXPECT_EQ(
        refusalOf(text + "&" + key + "=" + value),
        "player '" + text + "&" + key + "=" + value + "': " + key + " is given twice" + kExpected);
  }
}

TEST(PlayerWish, ThatCantBeReadSaysWhy) {
  for (const auto& [text, why] :
       std::vector<std::pair<std::string, std::string>>{{"", "names no plugin"},
                                                        {":a=1", "names no plugin"},
                                                        {"x@", "not the name of a team"},
                                                        {"x@red blue", "not the name of a team"},
                                                        {"x:a", "'a' is not key=value"},
                                                        {"x:=1", "is not key=value"},
                                                        {"x:a=1&&b=2", "is not key=value"},
                                                        {"x:a=1&a=2", "a is given twice"},
                                                        {"x:name=a&name=b", "name is given twice"},
                                                        {"x:name=", "name is empty"},
                                                        {"x:robot=&k=v", "robot is empty"},
                                                        {"x:start=1", "start"},
                                                        {"x:stage=perhaps", "stage"}}) {
    SCOPED_TRACE(text);
    try {
      parsePlayer(text);
      ADD_FAILURE() << "was taken";
    } catch (const ConfigError& error) {
      EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
    }
  }
}

/// A scene of two players, and what is wrong with it.
std::string sceneWith(const std::string& player) {
  return "[scene]\nworld = \"w.toml\"\n[[player]]\nplugin = \"wander\"\nrobot = \"r.toml\"\n"
         "team = \"blue\"\nstart = { x_m = 1, y_m = 2, theta_deg = 90 }\noptions = { speed_m_s = "
         "0.3 }\n[[player]]\n" +
         player;
}

TEST(PlayerWish, IsReadFromAScene) {
  const test::TemporaryFolder folder;
  folder.write("w.toml",
               "[world]\nx_m = [-8, 8]\ny_m = [-8, 8]\n[[rectangle]]\ncenter_m = [-7.9, "
               "-7.9]\nsize_m = [0.1, 0.1]\n");
  folder.write("r.toml",
               "[robot]\nname = \"anna\"\nradius_m = 0.2\n[[sensor]]\nplugin = \"odometry\"\n");
  PluginFactory factory(PluginFactory::standardFolders());
  const Scene scene =
      Scene::read(folder.write("s.toml", sceneWith("plugin = \"wander\"\nrobot = \"r.toml\"\n")));
  SceneRun run(scene, {}, factory);
  const auto players = run.players().players();
  ASSERT_EQ(players.size(), 2u);
  EXPECT_EQ(players[0].robot, "anna");
  EXPECT_EQ(players[0].team, "blue");
  EXPECT_EQ(players[1].robot, "anna-2");
  EXPECT_FALSE(players[1].isGuest);
  EXPECT_EQ(run.simulation().robots()[0]->state().pose.y, 2.0);
  for (int i = 0; i < 300; ++i) run.step();
  const Twist velocity = run.simulation().robots()[0]->state().velocity;
  EXPECT_LT(std::hypot(velocity.x, velocity.y), 0.32);

  for (const auto& [player, why] : std::vector<std::pair<std::string, std::string>>{
           {"plugin = \"wander\"\n", "names no robot file"},
           {"plugin = \"wander\"\nrobot = \"none.toml\"\n", "none.toml"},
           {"plugin = \"nobody\"\nrobot = \"r.toml\"\n", "nobody"},
           {"plugin = \"wander\"\nrobot = \"r.toml\"\noptions = { speed = 1 }\n", "speed"},
           {"plugin = \"wander\"\nrobot = \"r.toml\"\noptions = { speed_m_s = \"x\" }\n",
            "speed_m_s"},
           {"plugin = \"wander\"\nrobot = \"r.toml\"\nspeed = 1\n", "speed"},
           {"plugin = \"wander\"\nrobot = \"r.toml\"\nname = \"anna\"\n", "anna"},
           {"plugin = \"wander\"\nrobot = \"r.toml\"\nteam = \"a b\"\n", "team"},
           {"plugin = \"wander\"\nrobot = \"r.toml\"\nname = \"a b\"\n", "[A-Za-z0-9_-]"},
           {"plugin = \"wander\"\nrobot = \"r.toml\"\nstage = false\n", "state"}}) {
    SCOPED_TRACE(player);
    try {
      const Scene bad = Scene::read(folder.write("b.toml", sceneWith(player)));
      const SceneRun refused(bad, {}, factory);
      ADD_FAILURE() << "was taken";
    } catch (const std::exception& error) {
      EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace ortung
