// Commands that whoever hosts the board adds to the protocol.
#include <gtest/gtest.h>
#include <sched.h>

#include <latch>
#include <map>
#include <set>
#include <thread>

#include "Await.hpp"
#include "CountingWorld.hpp"
#include "Files.hpp"
#include "RunningBoard.hpp"
#include "TestClient.hpp"

namespace ortung::test {
namespace {

/// Says what it was told: its caller, words and keys.
BoardCommand echo(const std::string& name = "ECHO") {
  return {name, "WORD ... [key=value ...], the same again", BoardCommand::Role::kViewer,
          [](const BoardCommand::Call& call) {
            if (call.words.empty()) throw ServeError("syntax", "ECHO needs words");
            BoardCommand::Reply reply;
            reply.words = "from=" + call.client;
            for (const std::string& word : call.words) reply.lines.push_back(word);
            for (const auto& [key, value] : call.keys) reply.lines.push_back(key + "=" + value);
            return reply;
          }};
}

TEST(Commands, OfTheHostAreAnsweredInTheirTurn) {
  CountingWorld world;
  BoardConfig config;
  config.commands = {echo()};
  const RunningBoard board(world, config);
  TestClient client(board.port());
  EXPECT_EQ(client.ask("ECHO a"), "ERR hello say HELLO ortung/1 first");
  client.ask("HELLO ortung/1 name=anna role=viewer");
  client.send("#1 echo one two key=4\n#2 TIME\n");
  EXPECT_EQ(client.line(), "#1 OK ECHO from=anna lines=3");
  EXPECT_EQ(client.line(), "one");
  EXPECT_EQ(client.line(), "two");
  EXPECT_EQ(client.line(), "key=4");
  EXPECT_TRUE(client.line().starts_with("#2 OK TIME"));
  EXPECT_EQ(client.ask("#3 ECHO"), "#3 ERR syntax ECHO needs words");
  EXPECT_EQ(client.ask("ECHO one key=3 key=4"), "ERR syntax ECHO has key= twice, expected it once");
}

TEST(Commands, OfTheHostStandBehindTheProtocolsInHelp) {
  CountingWorld world;
  BoardConfig config;
  config.commands = {echo()};
  const RunningBoard board(world, config);
  TestClient client(board.port());
  std::string last;
  for (int lines = std::stoi(valueOf(client.ask("HELP"), "lines")); lines > 0; --lines)
    last = client.line();
  EXPECT_EQ(last, "ECHO WORD ... [key=value ...], the same again");
}

TEST(Commands, SomeAreForOperators) {
  CountingWorld world;
  BoardConfig config;
  config.control = {"olga"};
  config.commands = {echo("SECRET")};
  config.commands.front().least = BoardCommand::Role::kOperator;
  const RunningBoard board(world, config);
  TestClient anna(board.port());
  anna.ask("HELLO ortung/1 name=anna");
  EXPECT_EQ(anna.ask("SECRET x"),
            "ERR role SECRET needs the role operator, this client is a player");
  TestClient olga(board.port());
  olga.ask("HELLO ortung/1 name=olga");
  EXPECT_EQ(olga.ask("SECRET x"), "OK SECRET from=olga lines=1");
}

TEST(Commands, TheirErrorsAndStrangeTextsHarmNobody) {
  CountingWorld world;
  BoardConfig config;
  config.commands = {{"BREAK", "", BoardCommand::Role::kViewer,
                      [](const auto&) -> BoardCommand::Reply { throw std::runtime_error("ouch"); }},
                     {"THROW", "", BoardCommand::Role::kViewer,
                      [](const auto&) -> BoardCommand::Reply { throw 5; }},
                     {"BELL", "", BoardCommand::Role::kViewer,
                      [](const auto&) { return BoardCommand::Reply{"a\nb", {"\x07"}}; }}};
  const RunningBoard board(world, config);
  TestClient client(board.port());
  client.ask("HELLO ortung/1");
  EXPECT_EQ(client.ask("BREAK"), "ERR internal ouch");
  EXPECT_EQ(client.ask("THROW"), "ERR internal it threw no std::exception");
  EXPECT_EQ(client.ask("BELL"), "OK BELL a?b lines=1");
  EXPECT_EQ(client.line(), "?");
}

/// A slow command that does not come back before the test lets it.
struct Blocking {
  BoardCommand command() {
    return {.name = "THINK",
            .help = "",
            .handle =
                [this](const BoardCommand::Call&) {
                  begun.count_down();
                  let.wait();
                  return BoardCommand::Reply{.words = "", .bytes = std::string("a\0\n", 3)};
                },
            .isSlow = true};
  }
  std::latch begun{1};
  std::latch let{1};
};

TEST(Commands, ThatAreSlowHoldUpNeitherTheWorldNorOtherClients) {
  CountingWorld world;
  Blocking blocking;
  BoardConfig config = controlledConfig();
  config.commands = {blocking.command(), echo()};
  const RunningBoard board(world, config);
  TestClient anna(board.port());
  TestClient bob(board.port());
  anna.ask("HELLO ortung/1 name=anna");
  bob.join(kAnyRobot, "bob");
  anna.send("#0 TIME\n#1 THINK\n#2 ECHO later\n");
  EXPECT_TRUE(anna.line().starts_with("#0 OK TIME"));
  blocking.begun.wait();
  bob.ask("LOCKSTEP on");
  for (int cycles = 1; cycles <= 20; ++cycles)
    EXPECT_EQ(valueOf(bob.ask("NEXT none/*/*"), "now"), std::to_string(10'000 * cycles));
  EXPECT_EQ(bob.ask("ECHO x"), "OK ECHO from=bob lines=1");
  EXPECT_EQ(bob.line(), "x");
  blocking.let.count_down();
  EXPECT_EQ(anna.line(), "#1 OK THINK bytes=3");
  EXPECT_EQ(anna.bytes(3), std::string("a\0\n", 3));
  EXPECT_EQ(anna.line(), "#2 OK ECHO from=anna lines=1");
}

TEST(Commands, ThatAreSlowHaveAThreadThatIsNeitherTheWorldsNorTheClients) {
  CountingWorld world;
  std::set<std::thread::id> threads;
  std::map<std::string, int> policies;
  const auto named = [&](const std::string& name, bool isSlow) {
    return BoardCommand{.name = name,
                        .help = "",
                        .handle =
                            [&, name](const BoardCommand::Call&) {
                              threads.insert(std::this_thread::get_id());
                              policies[name] = ::sched_getscheduler(0);
                              return BoardCommand::Reply{};
                            },
                        .isSlow = isSlow};
  };
  BoardConfig config;
  config.commands = {named("WORLDS", false), named("SLOW", true), named("MORE", true)};
  const RunningBoard board(world, config);
  TestClient client(board.port());
  client.ask("HELLO ortung/1");
  for (const char* command : {"WORLDS", "SLOW", "MORE"}) client.ask(command);
  EXPECT_EQ(threads.size(), 2U);
  EXPECT_FALSE(threads.contains(std::this_thread::get_id()));
  EXPECT_EQ(policies["WORLDS"], ::sched_getscheduler(0));
  EXPECT_EQ(policies["SLOW"], SCHED_BATCH);
  EXPECT_EQ(policies["MORE"], SCHED_BATCH);
}

TEST(Commands, ThatAreSlowSeeThatNobodyWaitsForThemAnyMore) {
  CountingWorld world;
  std::latch begun{1};
  std::latch gone{1};
  BoardConfig config;
  config.commands = {{.name = "THINK",
                      .help = "",
                      .handle =
                          [&](const BoardCommand::Call& call) {
                            begun.count_down();
                            EXPECT_TRUE(comesTrue("nobody waits for it any more",
                                                  [&] { return !call.isAwaited(); }));
                            gone.count_down();
                            return BoardCommand::Reply{};
                          },
                      .isSlow = true}};
  const RunningBoard board(world, config);
  {
    TestClient client(board.port());
    client.ask("HELLO ortung/1");
    client.send("THINK\n");
    begun.wait();
    client.kill();
  }
  gone.wait();
}

TEST(Commands, KnowWhoMayDoWhat) {
  CountingWorld world;
  BoardConfig config;
  config.control = {"olga"};
  config.commands = {{"WHO", "", BoardCommand::Role::kViewer, [](const BoardCommand::Call& call) {
                        return BoardCommand::Reply{std::to_string(static_cast<int>(call.role))};
                      }}};
  const RunningBoard board(world, config);
  const auto roleOf = [&](const std::string& greeting) {
    TestClient client(board.port());
    client.ask("HELLO ortung/1 " + greeting);
    return client.ask("WHO");
  };
  EXPECT_EQ(roleOf("name=anna role=viewer"), "OK WHO 0");
  EXPECT_EQ(roleOf("name=anna"), "OK WHO 1");
  EXPECT_EQ(roleOf("name=olga"), "OK WHO 2");
}

TEST(Commands, ThatMakeNoSenseAreRefusedAtConstruction) {
  CountingWorld world;
  const auto complaint = [&](const std::vector<BoardCommand>& commands) {
    BoardConfig config;
    config.commands = commands;
    return messageOf<std::invalid_argument>([&] { MessageBoard(world, config); });
  };
  EXPECT_EQ(complaint({echo("HELLO")}), "the command 'HELLO' is one of the protocol's own");
  EXPECT_EQ(complaint({echo("READ")}), "the command 'READ' is one of the protocol's own");
  EXPECT_EQ(complaint({echo(), echo()}), "the command 'ECHO' is there twice");
  for (const char* name : {"", "echo", "E CHO", "1ECHO", "E\n"})
    EXPECT_NE(complaint({echo(name)}).find("must be of capitals"), std::string::npos) << name;
  EXPECT_EQ(complaint({{"ECHO", "", BoardCommand::Role::kViewer, {}}}),
            "the command 'ECHO' has nobody who executes it");
  BoardCommand chatty = echo();
  chatty.help = "two\nlines";
  EXPECT_NE(complaint({chatty}).find("has a help that is not one line"), std::string::npos);
}

}  // namespace
}  // namespace ortung::test
