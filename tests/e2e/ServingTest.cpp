// `ortung sim --listen` and `ortung serve` as their users meet them.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <cstdio>
#include <memory>
#include <thread>
#include <vector>

#include "Await.hpp"
#include "CountingWorld.hpp"
#include "Files.hpp"
#include "Interrupt.hpp"
#include "Paths.hpp"
#include "Program.hpp"
#include "Serving.hpp"
#include "TestClient.hpp"
#include "ortung/client/RemoteRobot.hpp"

namespace ortung::test {
namespace {

const std::string kMaps = ORTUNG_SOURCE_DIR "/maps";
const std::string kRobot = kMaps + "/robots/pioneer.toml";

std::uint16_t portOf(Program& server) {
  const std::string out = server.waitForOutput("\n");
  const std::size_t place = out.find("port ");
  if (place == std::string::npos) throw std::runtime_error("the server did not start");
  return static_cast<std::uint16_t>(std::stoi(out.substr(place + 5)));
}

/// Output of a command and whether it succeeded.
std::pair<std::string, bool> run(const std::string& command) {
  FILE* pipe = ::popen(command.c_str(), "r");
  std::string text;
  char piece[4096];
  std::size_t count = 0;
  while ((count = std::fread(piece, 1, sizeof piece, pipe)) > 0) text.append(piece, count);
  return {text, ::pclose(pipe) == 0};
}

TEST(Serving, TheExamplesPlayOnAServer) {
  Program server({"sim", kMaps + "/fields/arena.toml", "--listen", "0"});
  const std::string address =
      " 127.0.0.1 " + std::to_string(portOf(server)) + " '" + kRobot + "' 1";
  for (const std::string& client :
       {std::string("'" ORTUNG_EXAMPLES "/avoid'"), std::string("'" ORTUNG_EXAMPLES "/avoid_c'"),
        std::string("'" ORTUNG_PYTHON "' '" ORTUNG_SOURCE_DIR "/examples/avoid.py'")}) {
    const auto [text, succeeded] = run(client + address);
    EXPECT_TRUE(succeeded) << client;
    EXPECT_NE(text.find("m ahead"), std::string::npos) << client << "\n" << text;
  }
  server.signal(SIGTERM);
  EXPECT_EQ(server.finish().exitCode, 0);
}

/// A world whose first cycle never ends; it is told to end meanwhile.
class StuckWorld : public CountingWorld {
 public:
  ~StuckWorld() override = default;
  void step() override {
    std::raise(SIGTERM);
    ::alarm(60);  // the test fails if nobody ends it before
    while (true) ::pause();
  }
};

TEST(Serving, ASignalEndsTheServerAlthoughACycleHangs) {
  EXPECT_EXIT(
      {
        app::catchInterrupts();
        StuckWorld world;
        app::ServingArguments arguments;
        arguments.listen = "0";
        app::serve(world, arguments);
      },
      testing::ExitedWithCode(128 + SIGTERM), "has not ended within 2 s after the signal");
}

TEST(Serving, AnEmptyAddressIsNoAddress) {
  const Outcome outcome = ortung({"sim", kMaps + "/fields/arena.toml", "--listen", ""});
  EXPECT_EQ(outcome.exitCode, 2);
  EXPECT_NE(outcome.err.find("--listen is '', expected [ADDRESS:]PORT"), std::string::npos)
      << outcome.err;
}

TEST(Serving, HowManyClientsThereAreIsAnOption) {
  Program server({"sim", kMaps + "/fields/arena.toml", "--listen", "0", "--clients", "3",
                  "--clients-per-address", "2"});
  const std::uint16_t port = portOf(server);
  TestClient first(port);
  TestClient second(port);
  first.ask("HELLO ortung/1");
  second.ask("HELLO ortung/1");
  EXPECT_EQ(TestClient(port).ask("HELLO ortung/1"),
            "* ERR limit there are 2 clients from 127.0.0.1 already");
  server.signal(SIGTERM);
  EXPECT_EQ(server.finish().exitCode, 0);
}

TEST(Serving, EndsOnASignalWhileRobotsOfManyPiecesPushEachOther) {
  Program server({"sim", kMaps + "/fields/msl.toml", "--listen", "0"});
  const std::uint16_t port = portOf(server);
  std::string star = "[[sensor]]\nplugin = \"odometry\"\n";
  for (int i = 0; i < 32; ++i)
    star +=
        "[[body]]\ncenter_m = [0, 0]\nsize_m = [0.4, 0.39]\nangle_deg = " + std::to_string(3 * i) +
        "\n";
  std::vector<std::unique_ptr<TestClient>> clients;
  for (int i = 0; i < 8; ++i) {
    TestClient& client = *clients.emplace_back(std::make_unique<TestClient>(port));
    const double angle = 0.7854 * i;
    const std::string place = "x_m=" + std::to_string(std::cos(angle)) +
                              " y_m=" + std::to_string(std::sin(angle)) +
                              " theta_deg=" + std::to_string(45 * i - 180);
    ASSERT_TRUE(client.join(star, "star" + std::to_string(i), place).starts_with("OK CREATE"));
    EXPECT_EQ(client.ask("VELOCITY v_m_s=0.8"), "OK VELOCITY");
  }
  const int cycles = std::stoi(valueOf(clients[0]->ask("STATUS"), "cycles"));
  EXPECT_TRUE(comesTrue("150 cycles are over", [&] {
    return std::stoi(valueOf(clients[0]->ask("STATUS"), "cycles")) >= cycles + 150;
  }));
  server.signal(SIGTERM);
  EXPECT_EQ(server.finish().exitCode, 0);
}

TEST(Serving, AServerThatIsKilledIsToldByTheClient) {
  auto server = std::make_unique<Program>(
      std::vector<std::string>{"sim", kMaps + "/fields/arena.toml", "--listen", "0"});
  const std::string port = std::to_string(portOf(*server));
  RemoteOptions options;
  options.session.port = static_cast<std::uint16_t>(std::stoi(port));
  options.cycle = 0.01;
  RemoteRobot robot(kRobot, options);
  ASSERT_TRUE(robot.waitForUpdate(20.0));
  server->signal(SIGKILL);
  server->finish();
  ASSERT_TRUE(comesTrue("the client is cut off", [&] { return !robot.isConnected(); }));
  EXPECT_TRUE(robot.trouble().starts_with("127.0.0.1:" + port + ": ")) << robot.trouble();
  const Program again({"sim", kMaps + "/fields/arena.toml", "--listen", port});
  ASSERT_TRUE(robot.waitForUpdate(20.0)) << robot.trouble();
}

TEST(Serving, ARecordIsServedLikeASimulation) {
  const TemporaryFolder folder;
  const std::string record = folder / "run.txt";
  const Outcome imported = ortung({"import", "sim", kMaps + "/fields/arena.toml", "--out", record,
                                   "--with-robot", kRobot, "--option", "duration=1"});
  ASSERT_EQ(imported.exitCode, 0) << imported.err;
  Program server({"serve", record, "--listen", "0", "--lockstep"});
  TestClient client(portOf(server));
  EXPECT_EQ(client.ask("HELLO ortung/1"),
            "OK HELLO ortung/1 client=1 role=player kind=record world=run now=0 state=waiting");
  client.send("CREATE r\n" + readBytes(kRobot) + ".\n");
  EXPECT_EQ(client.line(), "OK CREATE robot=1 features=15");
  EXPECT_EQ(client.ask("VELOCITY v_m_s=1"), "OK VELOCITY");
  EXPECT_EQ(client.ask("LOCKSTEP on"), "OK LOCKSTEP on");
  // All that it gives is the record.
  std::string all;
  for (std::string head = client.ask("NEXT"); head.starts_with("OK"); head = client.ask("NEXT"))
    for (int lines = std::stoi(valueOf(head, "lines")); lines > 0; --lines)
      all += client.line() + "\n";
  const std::string bytes = readBytes(record);
  const std::size_t lastNote = bytes.rfind("\n# ");
  EXPECT_EQ(all, bytes.substr(bytes.find('\n', lastNote + 1) + 1));
  server.signal(SIGINT);
  EXPECT_EQ(server.finish().exitCode, 0);
}

/// The readings of a client in lockstep, until there are @p count or no more.
std::vector<std::string> readingsOf(TestClient& client, std::size_t count, std::string& last) {
  std::vector<std::string> lines;
  for (last = client.ask("NEXT"); last.starts_with("OK"); last = client.ask("NEXT")) {
    for (int more = std::stoi(valueOf(last, "lines")); more > 0; --more)
      lines.push_back(client.line());
    if (lines.size() >= count) break;
  }
  return lines;
}

TEST(Serving, ARecordStartsOverOnlyWhereItIsAskedFor) {
  const TemporaryFolder folder;
  const std::string record = folder / "run.rec";
  ASSERT_EQ(ortung({"import", "sim", kMaps + "/fields/arena.toml", "--out", record, "--with-robot",
                    kRobot, "--option", "duration=1"})
                .exitCode,
            0);
  const auto served = [&](std::size_t count, const std::vector<std::string>& more,
                          std::string& last) {
    std::vector<std::string> command = {"serve", record, "--listen", "0", "--lockstep"};
    command.insert(command.end(), more.begin(), more.end());
    Program server(command);
    TestClient client(portOf(server));
    client.ask("HELLO ortung/1");
    client.send("CREATE r\n" + readBytes(kRobot) + ".\n");
    client.line();
    client.ask("LOCKSTEP on");
    std::vector<std::string> lines = readingsOf(client, count, last);
    server.signal(SIGINT);
    EXPECT_EQ(server.finish().exitCode, 0);
    return lines;
  };
  std::string last;
  const std::vector<std::string> once = served(100'000, {}, last);
  ASSERT_GT(once.size(), 20u);
  EXPECT_NE(last.find("ERR end"), last.npos) << last;
  const std::vector<std::string> twice = served(2 * once.size(), {"--repeat"}, last);
  EXPECT_TRUE(last.starts_with("OK")) << last;
  ASSERT_GE(twice.size(), 2 * once.size());
  const auto behindStamp = [](const std::string& line) { return line.substr(line.find(' ')); };
  for (std::size_t i = 0; i < 2 * once.size(); ++i) {
    ASSERT_EQ(behindStamp(twice[i]), behindStamp(once[i % once.size()])) << i;
    ASSERT_GE(std::stoll(twice[i]), std::stoll(twice[i == 0 ? 0 : i - 1])) << i;
  }
  EXPECT_GT(std::stoll(twice[once.size()]), std::stoll(once.back())) << "time goes on";
}

TEST(Serving, ASilentClientIsSentAwayAfterTheTimeOfTheOption) {
  Program server({"sim", kMaps + "/fields/arena.toml", "--listen", "0", "--idle", "1"});
  TestClient client(portOf(server));
  client.ask("HELLO ortung/1");
  EXPECT_NE(client.line().find("ERR idle nothing came for 1 s"), std::string::npos);
  EXPECT_EQ(client.line(), "(closed)");
  server.signal(SIGTERM);
  EXPECT_EQ(server.finish().exitCode, 0);
}

// A page of somebody else's that has its own name lead to this computer gets nothing.
TEST(Serving, BrowsersReachThePageByNamesOfTheOptionOnly) {
  Program server({"sim", kMaps + "/fields/arena.toml", "--view", "--no-browser", "--listen",
                  "127.0.0.1:0", "--view-host", "robot.example", "--view-host", "scout"});
  const std::uint16_t port = portOf(server);
  const auto statusFor = [port](const std::string& host) {
    TestClient client(port);
    client.send("GET / HTTP/1.1\r\nHost: " + host + ":" + std::to_string(port) + "\r\n\r\n");
    return client.line().substr(std::string("HTTP/1.1 ").size(), 3);
  };
  for (const char* host : {"127.0.0.1", "localhost", "robot.example", "scout"})
    EXPECT_EQ(statusFor(host), "200") << host;
  EXPECT_EQ(statusFor("evil.example"), "421");
  server.signal(SIGTERM);
  EXPECT_EQ(server.finish().exitCode, 0);
}

TEST(Serving, WhatCanNotBeServedIsToldInOneLine) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
      {{"sim", kMaps + "/fields/arena.toml", "--listen", "x"}, "--listen is 'x'"},
      {{"sim", kMaps + "/fields/arena.toml", "--listen", "70000"}, "--listen is '70000'"},
      {{"sim", kMaps + "/fields/arena.toml", "--listen", "0.0.0.0:0"}, "that needs a token"},
      {{"sim", kMaps + "/fields/arena.toml", "--listen", "0", "--lockstep", "--free-run"},
       "exclude each other"},
      {{"serve", kRobot, "--listen", "0", "--free-run", "--speed", "2"},
       "--free-run and --speed exclude each other"},
      {{"sim", kMaps + "/nowhere.toml", "--listen", "0"}, "can't be read"},
      {{"serve", kRobot, "--listen", "0"}, "expected '# ortung record 1'"}};
  for (const auto& [arguments, expected] : cases) {
    const Outcome outcome = ortung(arguments);
    EXPECT_NE(outcome.exitCode, 0);
    EXPECT_NE(outcome.err.find(expected), std::string::npos) << outcome.err;
  }
}

}  // namespace
}  // namespace ortung::test
