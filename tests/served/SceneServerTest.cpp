// A scene on the message board: its own robots play beside those of clients.
#include <gtest/gtest.h>

#include "Files.hpp"
#include "Paths.hpp"
#include "RunningBoard.hpp"
#include "TestClient.hpp"
#include "ortung/served/ServedSimulation.hpp"

namespace ortung::test {
namespace {

const std::string kScene = ORTUNG_SOURCE_DIR "/maps/scenes/kick.toml";
const std::string kRobot = ORTUNG_SOURCE_DIR "/maps/robots/pioneer.toml";

/// "robot=N now=T x y theta" of the true pose.
std::string truthOf(TestClient& client, int robot) {
  client.ask("READ */groundTruth/* robot=" + std::to_string(robot));
  return client.line();
}

TEST(SceneServer, ResidentsAreListedReadAndNobodys) {
  ServedSimulation world(kScene, {.noise = false});
  const RunningBoard board(world, controlledConfig());
  TestClient client(board.port());
  ASSERT_EQ(client.join(readBytes(kRobot), "guest").substr(0, 17), "OK CREATE robot=6");
  EXPECT_EQ(client.ask("LIST robots"), "OK LIST lines=6");
  EXPECT_EQ(client.line(), "robot=1 name=striker client=0");
  for (int i = 0; i < 4; ++i) client.line();
  EXPECT_EQ(client.line(), "robot=6 name=guest client=1");
  EXPECT_EQ(client.ask("VELOCITY v_m_s=0 robot=1"), "OK VELOCITY");  // an operator
  TestClient player(board.port());
  player.ask("HELLO ortung/1 role=player");
  EXPECT_EQ(player.ask("VELOCITY v_m_s=1 robot=1"), "ERR not-yours robot 1 belongs to the world");
  EXPECT_EQ(client.ask("REMOVE robot=1"), "ERR not-yours robot 1 belongs to the world");
  EXPECT_EQ(client.ask("PLACE robot=2 x_m=9 y_m=0.5"), "OK PLACE");
}

TEST(SceneServer, TheScriptIsPlayedAndStartsOverAtAReset) {
  ServedSimulation world(kScene, {.noise = false});
  const RunningBoard board(world, controlledConfig());
  TestClient client(board.port());
  client.join(readBytes(kRobot), "guest");
  client.ask("LOCKSTEP on");
  EXPECT_TRUE(client.ask("NEXT none/none/none").starts_with("OK NEXT"));
  const std::string atStart = truthOf(client, 1);
  ASSERT_TRUE(atStart.starts_with("0 reference/groundTruth/pose 3 ")) << atStart;
  EXPECT_TRUE(client.ask("NEXT cycles=200 none/none/none").starts_with("OK NEXT"));
  const std::string later = truthOf(client, 1);
  EXPECT_NE(later.substr(later.find(' ')), atStart.substr(1));  // it has driven
  EXPECT_TRUE(client.ask("RESET").starts_with("OK RESET now=0"));
  EXPECT_TRUE(client.ask("NEXT none/none/none").starts_with("OK NEXT"));
  EXPECT_EQ(truthOf(client, 1), atStart);
  EXPECT_TRUE(client.ask("NEXT cycles=200 none/none/none").starts_with("OK NEXT"));
  EXPECT_EQ(truthOf(client, 1), later);  // the same play again
}

}  // namespace
}  // namespace ortung::test
