// Robot 0: what a viewer sees of a world that is simulated.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "Files.hpp"
#include "Paths.hpp"
#include "RunningBoard.hpp"
#include "TestClient.hpp"
#include "ortung/served/ServedSimulation.hpp"

namespace ortung::test {
namespace {

const std::filesystem::path kScene = ORTUNG_SOURCE_DIR "/maps/scenes/kick.toml";

std::vector<std::string> linesOf(TestClient& client, const std::string& request) {
  std::vector<std::string> lines;
  for (int i = std::stoi(valueOf(client.ask(request), "lines")); i > 0; --i)
    lines.push_back(client.line());
  return lines;
}

std::vector<double> wordsOf(const std::string& line) {
  std::istringstream in(line);
  std::string stamp, feature, count;
  in >> stamp >> feature >> count;
  std::vector<double> words;
  for (double word = 0.0; in >> word;) words.push_back(word);
  EXPECT_EQ(words.size(), std::stoul(count));
  return words;
}

double metres(double word) { return (word - 2147483648.0) / 1000.0; }

TEST(Truth, TellsWhereRobotsAndObjectsAre) {
  ServedSimulation world(kScene, {.noise = false});
  const RunningBoard board(world, controlledConfig());
  TestClient client(board.port());
  client.ask("HELLO ortung/1");
  client.ask("PLACE robot=2 x_m=9 y_m=0.5 theta_deg=-90");
  client.ask("PLACE object=ball x_m=-1.25 y_m=2");
  const std::vector<std::string> truth = linesOf(client, "READ robot=0");
  ASSERT_EQ(truth.size(), 2u);
  const std::vector<double> robots = wordsOf(truth[0]);
  ASSERT_EQ(robots.size() % 5, 0u);
  std::size_t second = 0;
  while (second + 4 < robots.size() && robots[second] != 2.0) second += 5;
  ASSERT_LT(second, robots.size());
  EXPECT_NEAR(metres(robots[second + 1]), 9.0, 6e-4);
  EXPECT_NEAR(metres(robots[second + 2]), 0.5, 6e-4);
  EXPECT_NEAR(robots[second + 3], 27000.0, 1.0);
  const std::vector<double> objects = wordsOf(truth[1]);
  const std::vector<std::string> described = linesOf(client, "DESCRIBE world");
  ASSERT_EQ(objects.size(), 4 * (described.size() - 1));
  for (std::size_t i = 1; i < described.size(); ++i) {
    if (!described[i].starts_with("object=ball ")) continue;
    EXPECT_NEAR(metres(objects[4 * (i - 1)]), -1.25, 6e-4);
    EXPECT_NEAR(metres(objects[4 * (i - 1) + 1]), 2.0, 6e-4);
  }
}

TEST(Truth, IsToldAgainWhenSomethingIsPlacedInAWorldThatStands) {
  ServedSimulation world(kScene, {.noise = false});
  const RunningBoard board(world, controlledConfig());  // in lockstep, and nobody asks for cycles
  TestClient viewer(board.port());
  TestClient hand(board.port());
  viewer.ask("HELLO ortung/1 role=viewer");
  hand.ask("HELLO ortung/1 role=operator");
  EXPECT_EQ(viewer.ask("SUBSCRIBE robot=0 ahead=1 world/truth/objects"), "OK SUBSCRIBE robot=0");
  hand.ask("PLACE object=ball x_m=1 y_m=1");
  EXPECT_TRUE(viewer.line().starts_with("* UPDATE robot=0 "));
  EXPECT_NEAR(metres(wordsOf(viewer.line())[0]), 1.0, 6e-4);
  // It has not said that it got that: what comes meanwhile is not sent, but the newest is, later.
  hand.ask("PLACE object=ball x_m=2 y_m=1");
  hand.ask("PLACE object=ball x_m=3 y_m=1");
  EXPECT_EQ(viewer.ask("GOT robot=0"), "OK GOT");
  EXPECT_TRUE(viewer.line().starts_with("* UPDATE robot=0 "));
  EXPECT_NEAR(metres(wordsOf(viewer.line())[0]), 3.0, 6e-4);
}

TEST(Truth, IsNotForPlayers) {
  ServedSimulation world(kScene, {.noise = false});
  const RunningBoard board(world, lockstepConfig());
  TestClient client(board.port());
  client.ask("HELLO ortung/1");
  EXPECT_TRUE(client.ask("READ robot=0").starts_with("ERR not-yours"));
  EXPECT_TRUE(client.ask("SUBSCRIBE robot=0").starts_with("ERR not-yours"));
}

TEST(Truth, AViewerWatchesSeveralRobotsAtATime) {
  ServedSimulation world(kScene, {.noise = false});
  const RunningBoard board(world, controlledConfig());
  TestClient client(board.port());
  client.ask("HELLO ortung/1");
  for (const char* robot : {"0", "1", "2"})
    client.ask(std::string("SUBSCRIBE none/none/none robot=") + robot);
  client.send("PAUSE\nSTEP\n");
  for (const char* robot : {"0", "1", "2"})
    EXPECT_NE(client.lineWith("* UPDATE").find(std::string("robot=") + robot), std::string::npos);
  client.ask("UNSUBSCRIBE robot=1");
  client.send("STEP\n");
  for (const char* robot : {"0", "2"})
    EXPECT_NE(client.lineWith("* UPDATE").find(std::string("robot=") + robot), std::string::npos);
}

TEST(Field, IsDescribedAsTheWorldFileDrawsIt) {
  ServedSimulation world(ORTUNG_SOURCE_DIR "/maps/fields/f2000.toml", {.noise = false});
  const RunningBoard board(world, lockstepConfig());
  TestClient client(board.port());
  client.ask("HELLO ortung/1");
  std::map<std::string, int> kinds;
  double longest = 0.0;
  for (const std::string& line : linesOf(client, "DESCRIBE field")) {
    ++kinds[line.substr(0, line.find(' '))];
    if (line.starts_with("line "))
      longest = std::max(
          longest, std::hypot(std::stod(valueOf(line, "x1_m")) - std::stod(valueOf(line, "x0_m")),
                              std::stod(valueOf(line, "y1_m")) - std::stod(valueOf(line, "y0_m"))));
  }
  EXPECT_EQ(kinds["goal"], 6);       // two, of three parts each
  EXPECT_GE(kinds["landmark"], 4);   // corner posts
  EXPECT_GE(kinds["arc"], 5);        // the circle and four corners
  EXPECT_NEAR(longest, 12.0, 0.11);  // the touch line
}

TEST(Field, HasWhatStandsOnItAndIsNoWall) {
  ServedSimulation world(ORTUNG_SOURCE_DIR "/maps/fields/arena.toml", {.noise = false});
  const RunningBoard board(world, lockstepConfig());
  TestClient client(board.port());
  client.ask("HELLO ortung/1");
  std::vector<std::string> solids;
  for (const std::string& line : linesOf(client, "DESCRIBE field"))
    if (line.starts_with("solid ")) solids.push_back(line);
  ASSERT_EQ(solids.size(), 9u);  // three boxes, a tub, a wedge and four posts, but no ball
  // The box of 0.6 m x 0.4 m at (1.2, -1.3).
  EXPECT_EQ(solids.front(),
            "solid z0_m=0 z1_m=0.5 colour=brown 0.9,-1.5 1.5,-1.5 1.5,-1.1 0.9,-1.1");
}

}  // namespace
}  // namespace ortung::test
