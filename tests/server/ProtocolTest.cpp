#include <gtest/gtest.h>

#include "BoardClock.hpp"
#include "CountingWorld.hpp"
#include "Files.hpp"
#include "RunningBoard.hpp"
#include "TestClient.hpp"
#include "ortung/core/ReadingLine.hpp"

namespace ortung::test {
namespace {

TEST(Protocol, NothingIsAnsweredBeforeTheGreeting) {
  CountingWorld world;
  const RunningBoard board(world, {});
  TestClient client(board.port());
  EXPECT_EQ(client.ask("STATUS"), "ERR hello say HELLO ortung/1 first");
  EXPECT_EQ(client.ask("#a HELLO ortung/2"),
            "#a ERR version found 'ortung/2', this server speaks ortung/1");
  EXPECT_TRUE(client.ask("#b hello ortung/1").starts_with("#b OK HELLO ortung/1 client="));
  EXPECT_EQ(client.ask("HELLO ortung/1"), "ERR state HELLO was said already");
}

TEST(Protocol, LinesThatMakeNoSenseAreToldWhy) {
  CountingWorld world;
  const RunningBoard board(world, {});
  TestClient client(board.port());
  EXPECT_TRUE(client.join(kAnyRobot).starts_with("OK CREATE")) << "robot";
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"#", "ERR syntax found the tag '#', expected # and 1 to 32 of [A-Za-z0-9_-]"},
      {"#1", "#1 ERR syntax the line has no command; HELP lists them"},
      {"#2 VELOCITY", "#2 ERR syntax VELOCITY needs v_m_s or w_rad_s"},
      {"VELOCITY v_m_s=nan", "ERR number v_m_s is 'nan', expected a number from -1000 to 1000"},
      {"VELOCITY v_m_s=1e400", "ERR number v_m_s is '1e400', expected a number from -1000 to 1000"},
      {"VELOCITY v_m_s=", "ERR number v_m_s is '', expected a number from -1000 to 1000"},
      {"VELOCITY v=1", "ERR syntax VELOCITY does not know 'v='"},
      {"VELOCITY V_M_S=1", "ERR syntax VELOCITY does not know 'V_M_S=1'"},  // no key: a word
      {"VELOCITY v:m=1", "ERR syntax VELOCITY does not know 'v:m=1'"},
      {"VELOCITY v/m=1", "ERR syntax VELOCITY does not know 'v/m=1'"},
      {"VELOCITY v{=1", "ERR syntax VELOCITY does not know 'v{=1'"},
      {"VELOCITY `=1", "ERR syntax VELOCITY does not know '`=1'"},
      {"VELOCITY a0z_9=1", "ERR syntax VELOCITY does not know 'a0z_9='"},
      {"VELOCITY v_m_s=1 fast", "ERR syntax VELOCITY does not know 'fast'"},
      {"VELOCITY v_m_s=1 robot=7", "ERR no-robot there is no robot 7"},
      {"VELOCITY v_m_s=1 robot=-1",
       "ERR number robot is '-1', expected a whole number from 1 to 4294967295"},
      {"MOTION", "ERR syntax MOTION needs numbers"},
      {"MANIPULATOR kicker", "ERR syntax MANIPULATOR needs a state"},
      {"MANIPULATOR arm 1", "ERR no-manipulator there is only a kicker"},
      {"MANIPULATOR ../arm 1",
       "ERR syntax a manipulator and its state are 1 to 32 of [A-Za-z0-9_-]"},
      {"UPDATE LRF", "ERR syntax found 'LRF', expected model/type/feature, each a whole name or *"},
      {"UPDATE x*/y/z",
       "ERR syntax found 'x*/y/z', expected model/type/feature, each a whole name or *"},
      {"READ */**/*",
       "ERR syntax found '*/**/*', expected model/type/feature, each a whole name or *"},
      {"UPDATE form=xml", "ERR syntax form is 'xml', expected text or binary"},
      {"NEXT", "ERR state NEXT is for clients in lockstep: LOCKSTEP on"},
      {"LOCKSTEP maybe", "ERR syntax LOCKSTEP is 'maybe', expected on or off"},
      {"LIST secrets", "ERR syntax LIST knows worlds, plugins, clients and robots"},
      {"PLACE robot=1 x_m=1 y_m=1",
       "ERR role PLACE needs the role operator, this client is a player"},
      {"SCORE left=3", "ERR role setting the SCORE needs the role operator"},
      {"#t9 STATUS caf\xC3\xA9",
       "#t9 ERR syntax a line has characters that are no printable ASCII"},
      {"#t\x01 STATUS", "ERR syntax a line has characters that are no printable ASCII"},
      {"#d STATUS\x7F", "#d ERR syntax a line has characters that are no printable ASCII"},
      {"caf\xC3\xA9", "ERR syntax a line has characters that are no printable ASCII"},
      {std::string("STATUS\0", 7), "ERR syntax a line has characters that are no printable ASCII"}};
  for (const auto& [line, expected] : cases) EXPECT_EQ(client.ask(line), expected) << line;
}

TEST(Protocol, RepliesComeInTheOrderOfRequests) {
  CountingWorld world;
  const RunningBoard board(world, lockstepConfig());
  TestClient client(board.port());
  std::string all = "#h HELLO ortung/1\n#c CREATE r\n" + kAnyRobot + ".\n#l LOCKSTEP on\n";
  std::string expected = "#h#c#l";
  for (int i = 0; i < 40; ++i) {
    const std::string n = std::to_string(i);
    all += "#v" + n + " VELOCITY v_m_s=1\n#e" + n + " NONSENSE\n#n" + n + " NEXT\n#u" + n +
           " UPDATE\n#t" + n + " TIME\n";
    expected += "#v" + n + "#e" + n + "#n" + n + "#u" + n + "#t" + n;
  }
  client.send(all + "#bye BYE\n");
  std::string tags;
  for (std::string line = client.line(); line != "(closed)"; line = client.line())
    if (line.starts_with('#')) tags += line.substr(0, line.find(' '));
  EXPECT_EQ(tags, expected + "#bye");
}

TEST(Protocol, AnUpdateSendsEachReadingOnceAndReadSendsItAgain) {
  CountingWorld world;
  const RunningBoard board(world, lockstepConfig());
  TestClient client(board.port());
  client.join(kAnyRobot);
  client.ask("LOCKSTEP on");
  EXPECT_EQ(client.ask("UPDATE"), "OK UPDATE robot=1 now=0 lines=0");  // nothing was sensed yet
  EXPECT_EQ(client.ask("NEXT cycles=3 nothing/*/*"), "OK NEXT robot=1 now=30000 lines=0");
  EXPECT_EQ(client.ask("UPDATE counter/*/*"), "OK UPDATE robot=1 now=30000 lines=1");
  EXPECT_EQ(client.line(), "20000 counter/counter/cycle 2 2 0");
  EXPECT_EQ(client.ask("UPDATE"), "OK UPDATE robot=1 now=30000 lines=0");
  EXPECT_EQ(client.ask("READ"), "OK READ robot=1 now=30000 lines=1");
  EXPECT_EQ(client.line(), "20000 counter/counter/cycle 2 2 0");
}

TEST(Protocol, NextIsOneCycleUnlessItSaysHowMany) {
  CountingWorld world;
  const RunningBoard board(world, lockstepConfig());
  TestClient client(board.port());
  client.join(kAnyRobot);
  client.ask("LOCKSTEP on");
  EXPECT_EQ(client.ask("NEXT nothing/*/*"), "OK NEXT robot=1 now=10000 lines=0");
  EXPECT_EQ(client.ask("NEXT cycles=1 nothing/*/*"), "OK NEXT robot=1 now=20000 lines=0");
  EXPECT_EQ(client.ask("NEXT cycles=2 nothing/*/*"), "OK NEXT robot=1 now=40000 lines=0");
  EXPECT_EQ(client.ask("NEXT cycles=0"),
            "ERR number cycles is '0', expected a whole number from 1 to 1000000");
}

TEST(Protocol, TheBinaryFormHasTheSameWords) {
  CountingWorld world(1000);
  const RunningBoard board(world, lockstepConfig());
  TestClient client(board.port());
  client.join(kAnyRobot);
  client.ask("LOCKSTEP on");
  EXPECT_EQ(client.ask("NEXT nothing/*/*"), "OK NEXT robot=1 now=10000 lines=0");
  client.ask("READ camera/*/*");
  const auto text = parseLine(client.line());
  ASSERT_TRUE(text.has_value());
  const std::string reply = client.ask("READ camera/*/* form=binary");
  EXPECT_EQ(valueOf(reply, "readings"), "1");
  const std::string head = "0 camera/camera/image 1000\n";
  ASSERT_EQ(valueOf(reply, "bytes"), std::to_string(head.size() + 4000));
  const std::string body = client.bytes(head.size() + 4000);
  EXPECT_EQ(body.substr(0, head.size()), head);
  std::vector<std::uint32_t> words;
  for (std::size_t i = head.size(); i < body.size(); i += 4) {
    std::uint32_t word = 0;
    for (std::size_t k = 4; k-- > 0;) word = word << 8 | static_cast<unsigned char>(body[i + k]);
    words.push_back(word);
  }
  EXPECT_EQ(words, text->words);
}

TEST(Protocol, ReadingsTooLargeForALineComeInBinaryFormAloneAndTheReplySaysSo) {
  CountingWorld world(230'400);  // 640 x 480 in colour
  const RunningBoard board(world, lockstepConfig());
  TestClient client(board.port());
  client.join(kAnyRobot);
  client.ask("LOCKSTEP on");
  EXPECT_EQ(client.ask("NEXT"), "OK NEXT robot=1 now=10000 lines=1 left_out=1");
  EXPECT_EQ(client.line(), "0 counter/counter/cycle 2 0 0");
  EXPECT_EQ(client.ask("UPDATE camera/*/*"), "OK UPDATE robot=1 now=10000 lines=0 left_out=1");
  for (int i = 0; i < 30; ++i) {  // none of which ends the connection
    const std::string head = std::to_string(10'000 * i) + " camera/camera/image 230400\n";
    const std::string reply = client.ask("UPDATE camera/*/* form=binary");
    ASSERT_EQ(reply, "OK UPDATE robot=1 now=" + std::to_string(10'000 * (i + 1)) +
                         " bytes=" + std::to_string(head.size() + 4 * 230'400) + " readings=1");
    const std::string body = client.bytes(head.size() + 4 * 230'400);
    ASSERT_TRUE(body.starts_with(head));
    for (std::size_t at = head.size(); at < body.size(); at += 4)
      ASSERT_EQ(body.substr(at, 4), std::string("\x00\x28\x6B\xEE", 4));  // 4,000,000,000
    client.ask("NEXT nothing/*/*");
  }
}

TEST(Protocol, SubscribersGetWhatIsNewAfterEachPeriod) {
  CountingWorld world;
  const RunningBoard board(world, lockstepConfig());
  TestClient client(board.port());
  client.join(kAnyRobot);
  client.ask("LOCKSTEP on");
  EXPECT_EQ(client.ask("SUBSCRIBE period_s=0.05 counter/*/*"), "OK SUBSCRIBE robot=1");
  client.send("NEXT cycles=10 nothing/*/*\n");
  EXPECT_TRUE(client.lineWith("* UPDATE").starts_with("* UPDATE robot=1 now="));
  EXPECT_TRUE(parseLine(client.line()).has_value());
  client.lineWith("OK NEXT");
  client.send("UNSUBSCRIBE\nNEXT cycles=10\n");
  client.lineWith("OK NEXT");
  EXPECT_EQ(client.line(), "190000 counter/counter/cycle 2 19 0");
  EXPECT_TRUE(client.ask("STATUS").starts_with("OK STATUS"));  // and no update in between
}

TEST(Protocol, SubscribersThatComeLateKeepTheRhythmFromThenOn) {
  CountingWorld world;
  const RunningBoard board(world, lockstepConfig());
  TestClient client(board.port());
  client.join(kAnyRobot);
  client.ask("LOCKSTEP on");
  EXPECT_TRUE(client.ask("NEXT cycles=20 none/none/none").starts_with("OK NEXT"));
  client.ask("SUBSCRIBE period_s=0.05 counter/*/*");
  std::vector<std::string> told;
  for (int cycle = 0; cycle < 11; ++cycle) {
    client.send("NEXT none/none/none\nSTATUS\n");
    for (std::string line = client.line(); !line.starts_with("OK STATUS"); line = client.line())
      if (line.starts_with("* UPDATE")) told.push_back(valueOf(line, "now"));
  }
  EXPECT_EQ(told, (std::vector<std::string>{"210000", "260000", "310000"}));
}

TEST(Protocol, SubscribersKeepTheirRhythmWhenTheWorldStartsOver) {
  CountingWorld world;
  const RunningBoard board(world, controlledConfig());
  TestClient client(board.port());
  client.join(kAnyRobot);
  client.ask("LOCKSTEP on");
  client.ask("SUBSCRIBE period_s=0.05 none/none/none");
  client.send("NEXT cycles=30 none/none/none\n");
  client.lineWith("OK NEXT");
  client.send("RESET\n");
  client.lineWith("OK RESET");
  int told = 0;
  for (int cycle = 0; cycle < 20; ++cycle) {
    client.send("NEXT none/none/none\nSTATUS\n");
    for (std::string line = client.line(); !line.starts_with("OK STATUS"); line = client.line())
      told += line.starts_with("* UPDATE") ? 1 : 0;
  }
  EXPECT_EQ(told, 4);  // at 10, 60, 110 and 160 ms
}

TEST(Protocol, ARobotFileThatIsNotWantedIsReadAllTheSame) {
  CountingWorld world;
  const RunningBoard board(world, {});
  TestClient client(board.port());
  client.send("CREATE early\n" + kAnyRobot);
  EXPECT_EQ(client.ask("."), "ERR hello say HELLO ortung/1 first");
  client.ask("HELLO ortung/1 role=viewer");
  client.send("#a CREATE mine\n" + kAnyRobot);
  EXPECT_EQ(client.ask("."), "#a ERR role CREATE needs the role player, this client is a viewer");
  EXPECT_TRUE(client.ask("STATUS").starts_with("OK STATUS"));
}

TEST(Protocol, WhoWatchesARobotIsToldWhenItIsGone) {
  CountingWorld world;
  const RunningBoard board(world, {});
  TestClient anna(board.port());
  anna.join(kAnyRobot);
  TestClient viewer(board.port());
  viewer.ask("HELLO ortung/1 role=viewer");
  EXPECT_EQ(viewer.ask("SUBSCRIBE robot=1 period_s=0.02"), "OK SUBSCRIBE robot=1");
  EXPECT_EQ(anna.ask("REMOVE"), "OK REMOVE");
  EXPECT_EQ(viewer.lineWith("REMOVE"), "* REMOVE robot=1");
  EXPECT_TRUE(viewer.ask("STATUS").starts_with("OK STATUS"));  // and no update any more
}

TEST(Protocol, NobodyMakesTheOthersWaitOnAServerInRealTime) {
  CountingWorld world;
  BoardConfig config;
  config.control = {"boss"};
  const RunningBoard board(world, config);
  TestClient player(board.port());
  player.join(kAnyRobot);
  EXPECT_EQ(
      player.ask("LOCKSTEP on"),
      "ERR role LOCKSTEP makes all others wait: it needs a server started with --lockstep, or "
      "the role operator");
  EXPECT_EQ(player.ask("LOCKSTEP off"), "OK LOCKSTEP off");
  TestClient boss(board.port());
  boss.ask("HELLO ortung/1 name=boss");
  EXPECT_EQ(boss.ask("LOCKSTEP on"), "OK LOCKSTEP on");
}

TEST(Protocol, StepsOfAPausedWorldDoNotWaitForLockstepClients) {
  CountingWorld world;
  const RunningBoard board(world, controlledConfig());
  TestClient idle(board.port());
  idle.join(kAnyRobot);
  idle.ask("LOCKSTEP on");
  TestClient boss(board.port());
  boss.ask("HELLO ortung/1");
  EXPECT_EQ(boss.ask("PAUSE"), "OK PAUSE now=0");
  EXPECT_EQ(boss.ask("STEP cycles=3"), "OK STEP");
  EXPECT_EQ(valueOf(boss.ask("STATUS"), "now"), "30000");
}

TEST(BoardClock, StandsStillWhereTheWorldIsHeldUp) {
  server::BoardClock clock;
  clock.set(1000, 50'000, 2.0, 1500);
  EXPECT_EQ(clock.at(50'100), 1200);
  EXPECT_EQ(clock.at(60'000), 1500);
  clock.permit(5000);
  EXPECT_EQ(clock.at(50'500), 2000);
  clock.set(9000, 70'000, 0.0, 100);  // never before what was set
  EXPECT_EQ(clock.at(99'000), 9000);
}

TEST(Protocol, WhatOneSaysAllOthersHear) {
  CountingWorld world;
  const RunningBoard board(world, {});
  TestClient anna(board.port());
  TestClient bert(board.port());
  anna.join(kAnyRobot);
  bert.ask("HELLO ortung/1 name=bert");
  EXPECT_EQ(anna.ask("SAY I take the ball, x=3"), "OK SAY");
  EXPECT_EQ(bert.line(), "* SAY client=1 name=anna I take the ball, x=3");
  EXPECT_EQ(anna.ask("LIST clients"), "OK LIST lines=2");
  EXPECT_EQ(anna.line(), "client=1 name=anna robots=1 lockstep=off");
  EXPECT_EQ(anna.line(), "client=2 name=bert robots=0 lockstep=off");
}

TEST(Protocol, OperatorsControlTheSimulation) {
  CountingWorld world;
  BoardConfig config;
  config.control = {"olga"};
  const RunningBoard board(world, config);
  TestClient player(board.port());
  player.join(kAnyRobot, "anna");
  EXPECT_EQ(TestClient(board.port()).ask("HELLO ortung/1 name=bert role=operator"),
            "ERR role 'bert' may not control; see --allow-control");
  TestClient client(board.port());
  EXPECT_EQ(valueOf(client.ask("HELLO ortung/1 name=olga"), "role"), "operator");
  EXPECT_TRUE(client.ask("PAUSE").starts_with("OK PAUSE now="));
  EXPECT_EQ(client.ask("RESET seed=5"), "OK RESET now=0");
  EXPECT_EQ(player.line(), "* RESET now=0");
  EXPECT_EQ(client.ask("READ robot=1"), "OK READ robot=1 now=0 lines=0");
  EXPECT_EQ(client.ask("STEP cycles=5"), "OK STEP");
  EXPECT_EQ(client.ask("READ robot=1"), "OK READ robot=1 now=50000 lines=1");
  EXPECT_EQ(client.line(), "40000 counter/counter/cycle 2 4 0");
  EXPECT_EQ(client.ask("SCORE left=2 right=1"), "OK SCORE left=2 right=1");
  EXPECT_EQ(player.ask("SCORE"), "OK SCORE left=2 right=1");
  EXPECT_EQ(client.ask("PLACE robot=1 x_m=1 y_m=2 theta_deg=30"), "OK PLACE");
  EXPECT_EQ(client.ask("SPEED 0.0001"),
            "ERR number the speed is 0 (as fast as possible) or from 0.001 to 1000");
  EXPECT_EQ(client.ask("SPEED 20"), "OK SPEED");
  EXPECT_EQ(client.ask("RESUME"), "OK RESUME now=50000");
  EXPECT_EQ(client.ask("STEP"), "ERR state STEP is for a simulation that is paused");
}

TEST(Protocol, AResetStartsTheScoreOver) {
  CountingWorld world;
  const RunningBoard board(world, controlledConfig());
  TestClient client(board.port());
  client.ask("HELLO ortung/1");
  EXPECT_EQ(client.ask("SCORE left=3 right=2"), "OK SCORE left=3 right=2");
  EXPECT_EQ(client.ask("RESET"), "OK RESET now=0");
  EXPECT_EQ(client.ask("SCORE"), "OK SCORE left=0 right=0");
}

TEST(Protocol, ACommandVectorArrivesInItsOrder) {
  CountingWorld world;
  const RunningBoard board(world, lockstepConfig());
  TestClient client(board.port());
  client.join(kAnyRobot);
  EXPECT_EQ(client.ask("MOTION 1 -2.5 3e-2"), "OK MOTION");
  EXPECT_EQ(world.motion(), (std::vector<double>{1.0, -2.5, 0.03}));
}

TEST(Protocol, ClientsTouchTheirOwnRobotsOnly) {
  CountingWorld world;
  const RunningBoard board(world, {});
  TestClient anna(board.port());
  TestClient bert(board.port());
  anna.join(kAnyRobot);
  bert.join(kAnyRobot, "bert");
  for (const char* line :
       {"VELOCITY v_m_s=1 robot=1", "MOTION 1 robot=1", "REMOVE robot=1",
        "MANIPULATOR kicker 1 robot=1", "UPDATE robot=1", "READ robot=1", "SUBSCRIBE robot=1"})
    EXPECT_TRUE(bert.ask(line).starts_with("ERR not-yours")) << line;
  EXPECT_EQ(anna.ask("REMOVE"), "OK REMOVE");
  EXPECT_EQ(anna.ask("VELOCITY v_m_s=1"),
            "ERR no-robot this client has no robot; CREATE makes one");
}

TEST(Protocol, AWorldThatBreaksIsToldToThoseWhoWait) {
  CountingWorld world;
  world.failAt(3);
  const RunningBoard board(world, lockstepConfig());
  TestClient client(board.port());
  client.join(kAnyRobot);
  client.ask("LOCKSTEP on");
  EXPECT_EQ(client.ask("NEXT cycles=10"), "ERR failed the world broke");
  EXPECT_EQ(client.ask("NEXT"), "ERR failed the world broke");
  EXPECT_EQ(valueOf(client.ask("STATUS"), "state"), "failed");
}

TEST(Protocol, AtTheEndOfARecordNextSaysSo) {
  CountingWorld world;
  world.endAt(3);
  const RunningBoard board(world, lockstepConfig());
  TestClient client(board.port());
  client.join(kAnyRobot);
  client.ask("LOCKSTEP on");
  EXPECT_EQ(client.ask("NEXT cycles=2"), "OK NEXT robot=1 now=20000 lines=1");
  client.line();
  EXPECT_EQ(client.ask("NEXT cycles=10"), "OK NEXT robot=1 now=30000 lines=1");  // what there was
  client.line();
  EXPECT_EQ(client.ask("NEXT"), "ERR end there is nothing more to come");
  EXPECT_EQ(valueOf(client.ask("STATUS"), "state"), "ended");
}

}  // namespace
}  // namespace ortung::test
