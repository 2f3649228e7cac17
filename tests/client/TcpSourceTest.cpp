// The source "tcp", as `ortung eval` and `ortung localize` open it.
#include <gtest/gtest.h>

#include <array>

#include "../server/RunningBoard.hpp"
#include "../server/TestClient.hpp"
#include "Files.hpp"
#include "Paths.hpp"
#include "ScriptedServer.hpp"
#include "ortung/client/RobotSession.hpp"
#include "ortung/core/PluginFactory.hpp"
#include "ortung/core/Source.hpp"
#include "ortung/formats/ScalarData.hpp"
#include "ortung/served/ServedSimulation.hpp"
#include "ortung/server/ServedContainer.hpp"

namespace ortung::test {
namespace {

const std::string kWorld = ORTUNG_SOURCE_DIR "/maps/fields/arena.toml";
const std::string kRobot = ORTUNG_SOURCE_DIR "/maps/robots/pioneer.toml";

/// The source with these options; "path" and "robot" have defaults.
std::unique_ptr<Source> open(std::uint16_t port,
                             const std::map<std::string, std::string>& options) {
  Parameters parameters("tcp");
  parameters.set("path", "127.0.0.1:" + std::to_string(port));
  parameters.set("robot_file", kRobot);
  for (const auto& [key, value] : options) parameters.set(key, value);
  return PluginFactory(PluginFactory::standardFolders()).make<Source>("tcp", parameters);
}

TEST(TcpSource, OptionsThatMakeNoSenseAreToldWhy) {
  const std::vector<std::pair<std::map<std::string, std::string>, std::string>> cases = {
      {{{"path", "localhost"}}, "must be HOST:PORT"},
      {{{"path", ":7777"}}, "must be HOST:PORT"},
      {{{"path", "localhost:0"}}, "must be HOST:PORT"},
      {{{"path", "localhost:99999"}}, "must be HOST:PORT"},
      {{{"path", "localhost:7777x"}}, "must be HOST:PORT"},
      {{{"path", "localhost:"}}, "must be HOST:PORT"},
      {{{"duration", "-1"}}, "must be a number in"},
      {{{"duration", "nan"}}, "must be a number in"},
      {{{"start", "1,2"}}, "must be x,y,theta"},
      {{{"start", "1,2,3,4"}}, "must be x,y,theta"},
      {{{"lockstep", "maybe"}}, "lockstep"},
      {{{"drive", "away"}}, "drive"},
      {{{"name", "a role=viewer"}}, "expected 1 to 32 of [A-Za-z0-9_-]"},
      {{{"robot", "/nowhere.toml"}}, "can't be read"},
      {{{"robot_file", ""}}, "needs a robot file"}};
  for (const auto& [options, expected] : cases) {
    const std::string message = messageOf<ConfigError>([&] { open(1, options); });
    EXPECT_NE(message.find(expected), std::string::npos) << message;
  }
}

TEST(TcpSource, FollowsARunningRobot) {
  SensorContainer container;
  const SensorId id{"sonar", "range", "near"};
  container.add(std::make_unique<ScalarData>(id, Pose2{}, ScalarData::Config{}));
  ASSERT_TRUE(container.set(Message{1000, id, {700}}));
  ServedContainer::Config config;
  config.robot = "rover";
  config.period = 0.002;
  ServedContainer world(container, [] { return Timestamp{2000}; }, config);
  const RunningBoard board(world, {});
  const auto source = open(board.port(), {{"cycle_ms", "1"}, {"wait_s", "0"}});
  Message message;
  ASSERT_TRUE(source->next(message));
  EXPECT_EQ(toText(message.id), "sonar/range/near");
  EXPECT_EQ(message.stamp, 1000);
  EXPECT_EQ(message.words, std::vector<std::uint32_t>{700});
  EXPECT_LT(source->progress(), 0.0) << "it has no end of its own";
  ASSERT_TRUE(container.set(Message{1500, id, {800}}));
  ASSERT_TRUE(source->next(message));
  EXPECT_EQ(message.words, std::vector<std::uint32_t>{800});
}

TEST(TcpSource, NumbersHaveLimits) {
  const auto said = [](const std::string& key, const std::string& value) {
    return messageOf<std::runtime_error>([&] { open(1, {{key, value}}); });
  };
  for (const auto& [key, low, high, below, above] :
       {std::array{"duration", "0", "1e9", "-0.001", "1000000001"},
        std::array{"cycle_ms", "1", "100000", "0.999", "100000.1"},
        std::array{"timeout", "0.1", "1000000", "0.099", "1000001"}}) {
    for (const char* fine : {low, high})  // it gets as far as the server, which is not there
      EXPECT_NE(said(key, fine).find("can't connect"), std::string::npos) << said(key, fine);
    for (const char* wrong : {below, above}) {
      EXPECT_NE(said(key, wrong).find(key), std::string::npos) << said(key, wrong);
      EXPECT_NE(said(key, wrong).find("must be a number in"), std::string::npos);
    }
  }
}

TEST(TcpSource, WithoutAServerItSaysSo) {
  EXPECT_EQ(messageOf<std::runtime_error>([] { open(1, {}); }),
            "127.0.0.1:1: can't connect: Connection refused");
}

// An address of IPv6 has brackets around it, since it has colons itself.
TEST(TcpSource, BracketsAreNoPartOfAnAddress) {
  for (const char* path : {"[::1]:1", "::1:1", "[127.0.0.1]:1"}) {
    const std::string said =
        messageOf<std::runtime_error>([&] { open(1, {{"path", path}}); });  // nobody is there
    EXPECT_NE(said.find("can't connect"), std::string::npos) << said;
  }
}

TEST(TcpSource, WithoutLockstepItFollowsAWorldThatGoesOnByItself) {
  ServedSimulation world(kWorld, {});
  BoardConfig config;
  config.speed = 20.0;
  const RunningBoard board(world, config);
  {
    const auto source = open(board.port(), {{"lockstep", "off"}, {"cycle_ms", "5"}});
    FrameReader reader(*source);  // refuses time that runs backwards
    std::vector<Message> frame;
    std::size_t readings = 0;
    // However many cycles a busy client misses, others come.
    for (Timestamp last = 0; readings < 5 || last < 500'000; last = frame.front().stamp) {
      ASSERT_TRUE(reader.next(frame));
      readings += frame.size();
    }
    EXPECT_EQ(source->worldFingerprint(), readWorld(kWorld)->fingerprint());
    EXPECT_EQ(source->robotToml(), readBytes(kRobot));
  }
  const auto brief =
      open(board.port(), {{"lockstep", "off"}, {"cycle_ms", "5"}, {"duration", "1"}});
  Message message;
  while (brief->next(message)) {
  }
  EXPECT_NEAR(brief->progress(), 1.0, 1e-9);
}

TEST(TcpSource, WhereLockstepIsNotPermittedItFollowsUnlessItIsAskedFor) {
  ServedSimulation world(kWorld, {});
  BoardConfig config;
  config.speed = 20.0;
  const RunningBoard board(world, config);
  const std::string why =
      messageOf<ServerRefused>([&] { open(board.port(), {{"lockstep", "on"}}); });
  EXPECT_NE(why.find("LOCKSTEP makes all others wait"), std::string::npos) << why;
  const auto source = open(board.port(), {{"cycle_ms", "5"}});
  Message message;
  for (int readings = 0; readings < 5; ++readings) ASSERT_TRUE(source->next(message));
}

/// "auto" gives way to a server that does not permit it, and to nothing else.
TEST(TcpSource, OtherRefusalsOfLockstepAreErrors) {
  ScriptedServer server([](const std::string& request) -> std::optional<std::string> {
    if (request.starts_with("LOCKSTEP")) return "ERR limit only two may do that";
    return "";
  });
  const std::string why = messageOf<ServerRefused>([&] { open(server.port(), {}); });
  EXPECT_NE(why.find("only two may do that"), std::string::npos) << why;
}

TEST(TcpSource, AWorldThatStandsStillIsToldAfterTheTimeout) {
  ServedSimulation world(kWorld, {});
  BoardConfig config;
  config.control = {"*"};
  const RunningBoard board(world, config);
  TestClient boss(board.port());
  boss.ask("HELLO ortung/1");
  boss.ask("PAUSE");
  const auto source =
      open(board.port(), {{"lockstep", "off"}, {"cycle_ms", "5"}, {"timeout", "0.1"}});
  Message message;
  const std::string why = messageOf<ConnectionLost>([&] {
    while (source->next(message)) {
    }
  });
  EXPECT_NE(why.find("gave no reading for"), std::string::npos) << why;
  EXPECT_NE(why.find("state=paused"), std::string::npos) << why;
}

TEST(TcpSource, AServerThatEndsIsNotTheEndOfTheRun) {
  ServedSimulation world(kWorld, {});
  BoardConfig config;
  config.pace = Pace::kLockstep;
  auto board = std::make_unique<RunningBoard>(world, config);
  const auto source = open(board->port(), {});
  Message message;
  EXPECT_TRUE(source->next(message));
  board.reset();
  const std::string what = messageOf<std::runtime_error>([&] {
    while (source->next(message)) {
    }
  });
  EXPECT_NE(what.find("the server says BYE"), std::string::npos) << what;
}

}  // namespace
}  // namespace ortung::test
