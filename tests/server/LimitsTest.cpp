// What a client may take, and who may come in.
#include <gtest/gtest.h>

#include <chrono>

#include "Await.hpp"
#include "CountingWorld.hpp"
#include "Files.hpp"
#include "RunningBoard.hpp"
#include "TestClient.hpp"

namespace ortung::test {
namespace {

/// Until the robot has sensed something.
void waitForReadings(TestClient& client) {
  EXPECT_TRUE(comesTrue("it has a reading",
                        [&] { return valueOf(client.ask("READ counter/*/*"), "lines") == "1"; }));
  client.line();
}

TEST(Limits, ALineThatIsTooLongEndsTheConnection) {
  CountingWorld world;
  const RunningBoard board(world, {});
  TestClient client(board.port());
  client.send(std::string(200'000, 'x'));
  EXPECT_EQ(client.line(), "* ERR line a line is longer than 65536 bytes");
  EXPECT_EQ(client.line(), "(closed)");
}

TEST(Limits, ARobotFileThatIsTooLongIsRefusedWhole) {
  CountingWorld world;
  const RunningBoard board(world, {});
  TestClient client(board.port());
  client.ask("HELLO ortung/1");
  client.send("CREATE big\n");
  for (int i = 0; i < 2000; ++i) client.send("# " + std::string(60, 'x') + "\n");
  EXPECT_EQ(client.ask("."), "ERR limit a robot file has at most 65536 bytes");
  client.send("CREATE small\n" + kAnyRobot);
  EXPECT_EQ(client.ask("."), "OK CREATE robot=1 features=2");
}

TEST(Limits, ARobotFileMayHaveAsManyBytesAsAreSaid) {
  CountingWorld world;
  for (const bool isTooLong : {false, true}) {
    const std::string comment = "# a comment\n";
    BoardConfig config;
    config.limits.configuration = kAnyRobot.size() + comment.size() - (isTooLong ? 1 : 0);
    const RunningBoard board(world, config);
    TestClient client(board.port());
    const std::string reply = client.join(kAnyRobot + comment);
    if (isTooLong)
      EXPECT_EQ(reply, "ERR limit a robot file has at most " +
                           std::to_string(config.limits.configuration) + " bytes");
    else
      EXPECT_EQ(reply, "OK CREATE robot=1 features=2");
  }
}

TEST(Limits, RobotsAndSensorsAreCounted) {
  CountingWorld world;
  BoardConfig config;
  config.limits.robots = 2;
  config.limits.sensors = 3;
  const RunningBoard board(world, config);
  TestClient client(board.port());
  EXPECT_EQ(client.join(kAnyRobot), "OK CREATE robot=1 features=2");
  client.send("CREATE b\n" + kAnyRobot + kAnyRobot + kAnyRobot + kAnyRobot);
  EXPECT_EQ(client.ask("."), "ERR limit the robot has 4 sensors, at most 3 are permitted");
  client.send("CREATE c\n" + kAnyRobot);
  EXPECT_EQ(client.ask("."), "OK CREATE robot=2 features=2");
  client.send("CREATE d\n" + kAnyRobot);
  EXPECT_EQ(client.ask("."), "ERR limit a client has at most 2 robots");
  EXPECT_EQ(client.ask("REMOVE robot=1"), "OK REMOVE");
  client.send("CREATE unwanted\n" + kAnyRobot);
  EXPECT_EQ(client.ask("."), "ERR no-room there is no room");
  client.send("CREATE e\n" + kAnyRobot);
  EXPECT_EQ(client.ask("."), "OK CREATE robot=3 features=2");
}

TEST(Limits, FeaturesAreCountedAndTheRobotIsTakenOffAgain) {
  CountingWorld world;
  BoardConfig config;
  config.limits.features = 1;
  const RunningBoard board(world, config);
  TestClient client(board.port());
  EXPECT_EQ(client.join(kAnyRobot), "ERR limit the robot has 2 features, at most 1 are permitted");
  EXPECT_EQ(valueOf(client.ask("STATUS"), "robots"), "0");
}

TEST(Limits, SensorsThatWouldHoldUpAllOthersAreRefused) {
  CountingWorld world;
  world.raysPerSecond = 2000.0;
  BoardConfig config;
  config.limits.rays = 1999.0;
  const RunningBoard board(world, config);
  TestClient client(board.port());
  EXPECT_EQ(
      client.join(kAnyRobot),
      "ERR limit the robot's sensors need 2000 rays a second, at most 1999 are permitted: fewer "
      "beams, or longer periods");
  EXPECT_EQ(valueOf(client.ask("STATUS"), "robots"), "0");
}

TEST(Limits, TheSensorsOfAllRobotsTogetherAreLimited) {
  CountingWorld world;
  world.raysPerSecond = 1000.0;
  world.raysAtOnce = 100.0;
  for (const bool inOneReading : {false, true}) {
    BoardConfig config;
    (inOneReading ? config.limits.allRaysAtOnce : config.limits.allRays) =
        inOneReading ? 250 : 2500;
    const RunningBoard board(world, config);
    TestClient first(board.port());
    TestClient second(board.port());
    EXPECT_TRUE(first.join(kAnyRobot).starts_with("OK CREATE"));
    EXPECT_TRUE(second.join(kAnyRobot).starts_with("OK CREATE"));
    second.send("CREATE b\n" + kAnyRobot);
    EXPECT_TRUE(second.ask(".").starts_with(
        "ERR limit the sensors of all robots would need 3000 rays a second and 300 at once"));
    EXPECT_EQ(valueOf(first.ask("STATUS"), "robots"), "2");
    EXPECT_EQ(first.ask("REMOVE"), "OK REMOVE");
    second.send("CREATE b\n" + kAnyRobot);
    EXPECT_TRUE(second.ask(".").starts_with("OK CREATE"));
  }
}

TEST(Limits, OneComputerCannotTakeAllPlaces) {
  CountingWorld world;
  BoardConfig config;
  config.limits.sessionsOfAddress = 2;
  const RunningBoard board(world, config);
  TestClient first(board.port());
  first.ask("HELLO ortung/1");
  {
    TestClient second(board.port());
    second.ask("HELLO ortung/1");
    TestClient third(board.port());
    EXPECT_EQ(third.ask("HELLO ortung/1"),
              "* ERR limit there are 2 clients from 127.0.0.1 already");
    EXPECT_EQ(third.line(), "(closed)");
  }
  ASSERT_TRUE(comesTrue("one client is left", [&] { return board.statistics().clients <= 1; }));
  std::string reply;
  EXPECT_TRUE(comesTrue("the places are given back", [&] {
    reply = TestClient(board.port()).ask("HELLO ortung/1");
    return !reply.starts_with("* ERR limit");
  }));
  EXPECT_TRUE(reply.starts_with("OK HELLO")) << reply;
}

TEST(Limits, OneClientTooManyIsTold) {
  CountingWorld world;
  BoardConfig config;
  config.limits.sessions = 2;
  const RunningBoard board(world, config);
  TestClient first(board.port());
  TestClient second(board.port());
  first.ask("HELLO ortung/1");
  second.ask("HELLO ortung/1");
  TestClient third(board.port());
  EXPECT_EQ(third.ask("HELLO ortung/1"), "* ERR limit there are 2 clients already");
  EXPECT_EQ(third.line(), "(closed)");
}

TEST(Limits, TooManyErrorsInARowEndTheConnection) {
  CountingWorld world;
  const RunningBoard board(world, {});
  TestClient client(board.port());
  client.ask("HELLO ortung/1");
  for (int i = 0; i < 99; ++i) EXPECT_TRUE(client.ask("NONSENSE").starts_with("ERR unknown"));
  EXPECT_EQ(client.ask("SAY x"), "OK SAY");
  for (int i = 0; i < 100; ++i) EXPECT_TRUE(client.ask("NONSENSE").starts_with("ERR unknown"));
  EXPECT_EQ(client.line(), "* ERR errors too many in a row");
}

TEST(Limits, WhoDoesNotReadIsToldAndDroppedWhileTheWorldGoesOn) {
  CountingWorld world(100'000);  // 0.4 MB a reading
  const RunningBoard board(world, {});
  TestClient slow(board.port());
  TestClient other(board.port());
  other.join(kAnyRobot, "other");
  slow.join(kAnyRobot, "slow");
  waitForReadings(slow);
  for (int i = 0; i < 100; ++i) slow.send("READ form=binary\n");
  // Dropped: its robot leaves the field although it has not read a byte.
  std::string status;
  ASSERT_TRUE(comesTrue("one robot is left", [&] {
    status = other.ask("STATUS");
    return valueOf(status, "robots") == "1";
  }));
  const auto cycles = std::stoll(valueOf(status, "cycles"));
  EXPECT_TRUE(comesTrue("the world goes on", [&] {
    return std::stoll(valueOf(other.ask("STATUS"), "cycles")) >= cycles + 3;
  }));
}

TEST(Limits, ASlowReaderFindsTheReasonAtTheEndOfItsOutput) {
  for (const std::size_t words : {2'000, 20'000}) {  // lines, and readings too large for one
    SCOPED_TRACE(words);
    CountingWorld world(words);
    BoardConfig config;
    config.limits.output = config.limits.readings = 100'000;
    const RunningBoard board(world, config);
    TestClient slow(board.port());
    slow.join(kAnyRobot);
    waitForReadings(slow);
    const std::string form = words > 8192 ? " form=binary" : "";
    for (int i = 0; i < 2000; ++i) slow.send("READ camera/*/*" + form + "\n");
    ASSERT_TRUE(comesTrue("it is dropped", [&] { return board.statistics().clients == 0; }));
    const std::string all = slow.rest();
    EXPECT_NE(all.find("* ERR slow more than 100000 bytes wait to be read"), std::string::npos);
  }
}

TEST(Limits, OutputThatIsNeverReadEndsTheConnection) {
  CountingWorld world(1'000'000);
  BoardConfig config;
  config.limits.stall = 0.05;
  const RunningBoard board(world, config);
  TestClient slow(board.port());
  slow.shrinkBuffer();
  slow.join(kAnyRobot);
  slow.ask("SUBSCRIBE form=binary");
  EXPECT_TRUE(comesTrue("it is dropped", [&] { return board.statistics().clients == 0; }));
}

TEST(Limits, SilenceEndsTheConnectionButNotForSubscribersOrThoseInLockstep) {
  CountingWorld world;
  BoardConfig config;
  config.limits.handshake = 1.0;  // all others must be heard within that, also on a busy machine
  config.limits.idle = 2.0;
  config.pace = Pace::kLockstep;
  const RunningBoard board(world, config);
  TestClient shy(board.port());
  TestClient subscriber(board.port());
  subscriber.join(kAnyRobot);
  subscriber.ask("SUBSCRIBE");
  TestClient waiting(board.port());
  waiting.join(kAnyRobot);
  waiting.ask("LOCKSTEP on");
  TestClient blocking(board.port());
  blocking.join(kAnyRobot);
  blocking.ask("LOCKSTEP on");
  waiting.send("NEXT\n");
  EXPECT_EQ(shy.line(), "* ERR hello it did not come within 1 s");
  EXPECT_TRUE(blocking.line().starts_with("* ERR idle"));
  // Without the one that kept silent, the world goes on.
  EXPECT_TRUE(waiting.line().starts_with("OK NEXT"));
  EXPECT_TRUE(subscriber.line().starts_with("* UPDATE"));
}

TEST(Limits, FloodsOfOrdersWaitInTheNetwork) {
  CountingWorld world;
  BoardConfig config;
  config.limits.orders = 4;
  const RunningBoard board(world, config);
  TestClient client(board.port());
  client.join(kAnyRobot);
  constexpr int kLines = 20'000;
  std::thread sender([&] {
    std::string lines;
    for (int i = 0; i < kLines; ++i) lines += "#" + std::to_string(i) + " VELOCITY v_m_s=1\n";
    client.send(lines);
  });
  for (int i = 0; i < kLines; ++i)
    ASSERT_EQ(client.line(), "#" + std::to_string(i) + " OK VELOCITY");
  sender.join();
}

TEST(Limits, SilenceEndsTheConnectionWhenItIsSaidTo) {
  CountingWorld world;
  BoardConfig config;
  config.limits.idle = 0.8;
  const RunningBoard board(world, config);
  TestClient client(board.port());
  const auto begin = std::chrono::steady_clock::now();
  client.ask("HELLO ortung/1");
  EXPECT_EQ(client.line(), "* ERR idle nothing came for 0 s");
  const double taken =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  EXPECT_GE(taken, 0.8);
  EXPECT_LT(taken, BoardLimits{}.idle - 5.0);  // that is what it is if nothing is said
}

TEST(Security, OnlyLoopbackIsServedWithoutTokens) {
  CountingWorld world;
  BoardConfig config;
  config.address = "0.0.0.0";
  EXPECT_EQ(messageOf<std::invalid_argument>([&] { MessageBoard(world, config); }),
            "0.0.0.0 can be reached from other computers: that needs a token");
  config.tokens = {{"*", "short"}};
  EXPECT_EQ(messageOf<std::invalid_argument>([&] { MessageBoard(world, config); }),
            "the token of '*' has less than 8 characters");
  config.address = "localhost";
  EXPECT_EQ(messageOf<std::invalid_argument>([&] { MessageBoard(world, config); }),
            "the address to listen on is 'localhost', expected numbers, e.g. 127.0.0.1 or ::1");
}

TEST(Security, ARobotFileNamesPluginsOfTheListAndNoFiles) {
  CountingWorld world;
  const RunningBoard board(world, {});
  TestClient client(board.port());
  client.ask("HELLO ortung/1");
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"[[sensor]]\nplugin = \"../../tmp/evil\"\n",
       "ERR configuration robot file:2: plugin has a slash or a control character, which a "
       "configuration from the network must not"},
      {"[[sensor]]\nplugin = \"sonar\"\n",
       "ERR configuration robot file:2: plugin is not one of the plugins of this server: odometry "
       "lrf"},
      {"[[sensor]]\nplugin = \"lrf\"\nweights_file = \"x\"\n",
       "ERR configuration robot file:3: weights_file names a file, which a configuration from the "
       "network must not"},
      {"[drive]\ndeep = [{ path = \"x\" }]\n",
       "ERR configuration robot file:2: path names a file, which a configuration from the network "
       "must not"},
      {"[[sensor]]\n", "ERR configuration robot file:1: plugin is missing"},
      {"= = =\n", ""},
      {std::string(70, '[') + "\n", ""}};
  for (const auto& [file, expected] : cases) {
    client.send("CREATE r\n" + file);
    const std::string reply = client.ask(".");
    EXPECT_TRUE(reply.starts_with(expected.empty() ? "ERR configuration" : expected))
        << file << reply;
  }
}

}  // namespace
}  // namespace ortung::test
