// What callers, servers and the network do to a client that they should not.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <mutex>

#include "../server/RunningBoard.hpp"
#include "Await.hpp"
#include "Files.hpp"
#include "Paths.hpp"
#include "ScriptedServer.hpp"
#include "ortung/client/RemoteRobot.hpp"
#include "ortung/client/ortung_client.h"
#include "ortung/served/ServedSimulation.hpp"

namespace ortung::test {
namespace {

const std::string kWorld = ORTUNG_SOURCE_DIR "/maps/fields/arena.toml";
const std::string kRobot = ORTUNG_SOURCE_DIR "/maps/robots/pioneer.toml";
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

RemoteOptions to(std::uint16_t port, double cycle = 0.01) {
  RemoteOptions options;
  options.session.port = port;
  options.cycle = cycle;
  return options;
}

/// A board with a world of its own.
struct Served {
  explicit Served(std::uint16_t port = 0) : world(kWorld, {}), board(world, config(port)) {}
  static BoardConfig config(std::uint16_t port) {
    BoardConfig config;
    config.port = port;
    return config;
  }
  ServedSimulation world;
  RunningBoard board;
};

double secondsOf(const std::function<void()>& action) {
  const auto begin = std::chrono::steady_clock::now();
  action();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

TEST(OnTrouble, WhatItThrowsIsPassedOverInEveryThread) {
  auto served = std::make_unique<Served>();
  const std::uint16_t port = served->board.port();
  std::atomic<int> told = 0;
  RemoteOptions options = to(port);
  options.onTrouble = [&](const std::string&) {
    if (++told % 2 == 0) throw std::runtime_error("of the owner's");
    throw 42;
  };
  RemoteRobot robot(kRobot, options);
  EXPECT_THROW(robot.setManipulator("arm", "up"), std::invalid_argument);  // not what it throws
  // The robot's own thread may be the one that tells it.
  ASSERT_TRUE(comesTrue("the refusal is told", [&] { return told >= 1; }));
  EXPECT_EQ(told, 1);
  served.reset();
  // By the thread that updates.
  ASSERT_TRUE(comesTrue("the loss is told", [&] { return told >= 2; }));
  EXPECT_FALSE(robot.waitForUpdate(0.0));
  const Served again(port);
  EXPECT_TRUE(robot.waitForUpdate(20.0)) << robot.trouble();
}

TEST(OnTrouble, MayUseTheRobotAndIsNotToldOfItself) {
  auto served = std::make_unique<Served>();
  const std::uint16_t port = served->board.port();
  std::atomic<RemoteRobot*> itself = nullptr;
  std::atomic<int> told = 0, failed = 0;
  RemoteOptions options = to(port);
  options.onTrouble = [&](const std::string& what) {
    RemoteRobot* robot = itself;
    if (robot == nullptr) return;
    robot->takeNews();
    robot->clockOffset();
    try {
      robot->setManipulator("leg", "down");  // another trouble
    } catch (const std::exception&) {
      ++failed;
    }
    if (what.starts_with("connected again")) return;
    ++told;
  };
  RemoteRobot robot(kRobot, options);
  itself = &robot;
  EXPECT_THROW(robot.setManipulator("arm", "up"), std::invalid_argument);
  // The robot's own thread may be the one that tells it.
  ASSERT_TRUE(comesTrue("the refusal is told", [&] { return told >= 1; }));
  EXPECT_EQ(told, 1);
  EXPECT_EQ(failed, 1);
  EXPECT_NE(robot.trouble().find("'leg'"), std::string::npos) << robot.trouble();
  served.reset();
  ASSERT_TRUE(comesTrue("the loss is told", [&] { return told >= 2; }));
  const Served again(port);
  EXPECT_TRUE(robot.waitForUpdate(20.0)) << robot.trouble();
}

TEST(OnTrouble, NobodyWaitsForTheOneWhoTells) {
  auto served = std::make_unique<Served>();
  std::mutex owners;
  std::atomic<bool> isTelling = false;
  std::atomic<int> told = 0;
  RemoteOptions options = to(served->board.port());
  options.onTrouble = [&](const std::string&) {
    isTelling = true;
    const std::lock_guard lock(owners);
    ++told;
  };
  RemoteRobot robot(kRobot, options);
  {
    const std::lock_guard lock(owners);
    served.reset();
    ASSERT_TRUE(comesTrue("the loss is told", [&] { return isTelling.load(); }));
    // The thread that updates waits for us; we do not wait for it.
    EXPECT_THROW(robot.setTranslationalVelocity(0.1), ConnectionLost);
    EXPECT_FALSE(robot.isConnected());
    EXPECT_NE(robot.trouble(), "");
  }
  ASSERT_TRUE(comesTrue("the loss was told", [&] { return told >= 1; }));
}

TEST(OnTrouble, IsToldOfTheNewestOfWhatHappensWhileItIsBusy) {
  const Served served;
  std::vector<std::string> told;
  RemoteRobot* itself = nullptr;
  RemoteOptions options = to(served.board.port(), 0.0);
  constexpr int kTroubles = 130;
  options.onTrouble = [&](const std::string& what) {
    told.push_back(what);
    if (told.size() > 1) return;
    std::thread([&] {
      for (int i = 0; i < kTroubles; ++i) {
        EXPECT_THROW(itself->setManipulator("arm" + std::to_string(i), "up"),
                     std::invalid_argument);
        itself->setTranslationalVelocity(0.0);  // else these were too many errors in a row
      }
    }).join();
  };
  RemoteRobot robot(kRobot, options);
  itself = &robot;
  EXPECT_THROW(robot.setManipulator("leg", "down"), std::invalid_argument);
  ASSERT_EQ(told.size(), 101u) << "it, and the newest hundred";
  EXPECT_NE(told.front().find("'leg'"), std::string::npos) << told.front();
  for (std::size_t i = 1; i < told.size(); ++i)
    EXPECT_NE(told[i].find("'arm" + std::to_string(kTroubles - 101 + i) + "'"), std::string::npos)
        << told[i];
}

/// A request at which the server hangs, and how.
struct Hang {
  std::string name;
  std::string request;
  std::optional<std::string> reply;  ///< nothing: silence
};

void PrintTo(const Hang& hang, std::ostream* out) {  // NOLINT: GoogleTest looks for this name
  *out << hang.name;
}

class HungServer : public testing::TestWithParam<Hang> {};

TEST_P(HungServer, EndsNobodysDestructor) {
  std::atomic<int> connections = 0;
  ScriptedServer server([&](const std::string& request) -> std::optional<std::string> {
    if (request.starts_with("HELLO")) ++connections;
    if (connections == 1 && request == "UPDATE" && GetParam().request != "UPDATE")
      return "OK UPDATE lines=nonsense";  // so that the client connects again
    if (request.starts_with(GetParam().request) && (connections > 1 || request == "UPDATE"))
      return GetParam().reply;
    return "";
  });
  RemoteOptions options = to(server.port());
  options.session.timeout = 600.0;
  auto robot = std::make_unique<RemoteRobot>(kRobot, options);
  ASSERT_TRUE(comesTrue("the server hangs", [&] { return server.isHung(); }));
  EXPECT_LT(secondsOf([&] { robot.reset(); }), 60.0);
}

INSTANTIATE_TEST_SUITE_P(, HungServer,
                         testing::Values(Hang{"SilentAtUpdate", "UPDATE", std::nullopt},
                                         Hang{"FloodsAtUpdate", "UPDATE", ScriptedServer::kFlood},
                                         Hang{"SilentWhileConnecting", "HELLO", std::nullopt},
                                         Hang{"SilentAtTime", "TIME", std::nullopt}),
                         [](const auto& hang) { return hang.param.name; });

TEST(SessionStop, EndsACallFromAnotherThread) {
  ScriptedServer server([](const std::string& request) -> std::optional<std::string> {
    if (request == "UPDATE") return std::nullopt;
    return "";
  });
  std::stop_source stop;
  SessionOptions options;
  options.port = server.port();
  options.timeout = 60.0;
  options.stop = stop.get_token();
  RobotSession session(options, "[robot]\n");
  std::thread other([&] {
    EXPECT_TRUE(comesTrue("the server hangs", [&] { return server.isHung(); }));
    stop.request_stop();
  });
  const std::string what = messageOf<ConnectionLost>([&] { session.update(); });
  other.join();
  EXPECT_EQ(what, "127.0.0.1:" + std::to_string(server.port()) + ": stopped");
}

TEST(SessionOptions, NamesAndTokensStayOneWord) {
  for (const std::string name : {"a role=viewer", "a\nBYE", "a\r", "role=viewer", "", "a.b", "\x7f",
                                 "123456789012345678901234567890123"}) {
    SessionOptions options;
    options.name = name;
    const std::string what = messageOf<std::invalid_argument>([&] { options.check(); });
    EXPECT_NE(what.find("expected 1 to 32 of [A-Za-z0-9_-]"), std::string::npos) << what;
    EXPECT_EQ(what.find('\n'), std::string::npos);
    options.port = 1;  // where nobody listens: it is refused before that shows
    EXPECT_THROW(RobotSession(options, ""), std::invalid_argument) << name;
    RemoteOptions remote;
    remote.session = options;
    EXPECT_THROW(RemoteRobot(kRobot, remote), std::invalid_argument) << name;
  }
  for (const std::string token : {"secret role=viewer", "secret\nBYE", "secr\xe9t"}) {
    SessionOptions options;
    options.token = token;
    const std::string what = messageOf<std::invalid_argument>([&] { options.check(); });
    EXPECT_EQ(what.find("secr"), std::string::npos) << what;
    EXPECT_NE(what.find("token"), std::string::npos) << what;
  }
}

TEST(SessionOptions, TimesAreAboveZero) {
  for (const double time : {0.0, -1.0, kNan}) {
    SessionOptions options;
    options.timeout = time;
    EXPECT_THROW(options.check(), std::invalid_argument) << time;
    options.timeout = kInfinity;
    EXPECT_NO_THROW(options.check());
    options.patience = time;
    EXPECT_THROW(options.check(), std::invalid_argument) << time;
  }
  for (const double cycle : {-0.1, kNan})
    EXPECT_THROW(RemoteRobot(kRobot, to(1, cycle)), std::invalid_argument) << cycle;
}

TEST(RobotSession, WhatIsNoNameOrQueryIsNotSent) {
  std::atomic<int> commands = 0;
  ScriptedServer server([&](const std::string& request) -> std::optional<std::string> {
    commands += request.starts_with("MANIPULATOR") || request.starts_with("UPDATE") ||
                request.starts_with("SAY");
    return "";
  });
  SessionOptions options;
  options.port = server.port();
  options.timeout = kInfinity;  // which is no reason to give up at once
  RobotSession session(options, "[robot]\n");
  EXPECT_THROW(session.setManipulator("arm", "up robot=2"), std::invalid_argument);
  EXPECT_THROW(session.setManipulator("arm\nBYE", "up"), std::invalid_argument);
  EXPECT_THROW(session.setManipulator("", "up"), std::invalid_argument);
  EXPECT_THROW(session.update("*/*/* robot=2"), std::invalid_argument);
  EXPECT_THROW(session.update("*/*/*\nBYE"), std::invalid_argument);
  EXPECT_THROW(session.say("hi\nBYE"), std::invalid_argument);
  EXPECT_EQ(commands, 0);
  session.setManipulator("arm-2", "up_1");
  session.update("*/LRF/* */odometry/pose");
  EXPECT_EQ(commands, 2);
}

TEST(RobotSession, CountsThatAreNoneEndTheConnection) {
  for (const std::string count :
       {"lines=x", "lines=-1", "lines=+1", "lines=1e3", "lines=0x1", "lines=1.0", "lines=1,",
        "lines=1048577", "lines=18446744073709551616", "lines=99999999999999999999999", "bytes=x",
        "bytes=-1", "bytes=268435457", "bytes=99999999999999999999999"}) {
    ScriptedServer server([&](const std::string& request) -> std::optional<std::string> {
      return request == "UPDATE" ? "OK UPDATE robot=1 now=0 " + count : "";
    });
    SessionOptions options;
    options.port = server.port();
    RobotSession session(options, "[robot]\n");
    EXPECT_EQ(messageOf<ConnectionLost>([&] { session.update(); }),
              options.server() + ": found 'OK UPDATE robot=1 now=0 " + count +
                  "', which is not ortung/1");
  }
}

TEST(RobotSession, KeepsTheFirst1000OfWhatIsSaidUnasked) {
  ScriptedServer server([&](const std::string& request) -> std::optional<std::string> {
    if (!request.starts_with("SAY ")) return "";
    std::string reply = "OK SAY";
    for (int i = 0; i < std::stoi(request.substr(4)); ++i)
      reply += "\n* SAY client=2 name=bert " + std::to_string(i);
    return reply;
  });
  SessionOptions options;
  options.port = server.port();
  RobotSession session(options, "[robot]\n");
  EXPECT_TRUE(session.takeNews().empty());
  session.say("3");
  session.say("0");  // what was said comes before the reply to this
  EXPECT_EQ(session.takeNews(),
            (std::vector<std::string>{"SAY client=2 name=bert 0", "SAY client=2 name=bert 1",
                                      "SAY client=2 name=bert 2"}));
  EXPECT_TRUE(session.takeNews().empty());
  session.say("1003");
  session.say("0");
  const std::vector<std::string> news = session.takeNews();
  ASSERT_EQ(news.size(), 1000u);
  EXPECT_EQ(news.back(), "SAY client=2 name=bert 999");
}

TEST(WaitForUpdate, LimitsAreWhatTheyAreSaidToBe) {
  const Served served;
  RemoteRobot still(kRobot, to(served.board.port(), 0.0));
  for (const double timeout : {0.0, -1.0, -kInfinity}) EXPECT_FALSE(still.waitForUpdate(timeout));
  EXPECT_THROW(still.waitForUpdate(kNan), std::invalid_argument);
  RemoteRobot robot(kRobot, to(served.board.port()));
  for (const double timeout : {1e300, kInfinity, 1e10})
    EXPECT_TRUE(robot.waitForUpdate(timeout)) << timeout;
}

TEST(ClientForC, NullIsAnErrorWithAText) {
  char text[64];
  const char* const file = kRobot.c_str();
  const auto connect = [&](const char* host, const char* robot, const char* name) {
    text[0] = '\0';
    EXPECT_EQ(ortung_connect(host, 1, robot, name, nullptr, 0.0, text, sizeof text), nullptr);
    return std::string(text);
  };
  EXPECT_EQ(connect(nullptr, file, "c"), "host is NULL");
  EXPECT_EQ(connect("127.0.0.1", nullptr, "c"), "robot_file is NULL");
  EXPECT_EQ(connect("127.0.0.1", file, nullptr), "name is NULL");
  EXPECT_EQ(ortung_connect(nullptr, 1, file, "c", nullptr, 0.0, nullptr, 9), nullptr);

  EXPECT_EQ(ortung_set_velocity(nullptr, 0.0, 0.0), 0);
  EXPECT_EQ(ortung_set_motion(nullptr, nullptr, 0), 0);
  EXPECT_EQ(ortung_set_manipulator(nullptr, "a", "b"), 0);
  EXPECT_EQ(ortung_update(nullptr), 0);
  EXPECT_EQ(ortung_next(nullptr, 1), 0);
  EXPECT_EQ(ortung_wait_for_update(nullptr, 0.0), 0);
  EXPECT_EQ(ortung_read(nullptr, "*/*/*", nullptr, 0, nullptr), -1);
  EXPECT_EQ(ortung_is_connected(nullptr), 0);
  ortung_trouble(nullptr, text, sizeof text);
  EXPECT_STREQ(text, "robot is NULL");
  ortung_trouble(nullptr, nullptr, 9);
  ortung_disconnect(nullptr);

  const Served served;
  ortung_robot* robot =
      ortung_connect("127.0.0.1", served.board.port(), file, "c", nullptr, 0.0, text, sizeof text);
  ASSERT_NE(robot, nullptr) << text;
  const auto trouble = [&] {
    ortung_trouble(robot, text, sizeof text);
    return std::string(text);
  };
  EXPECT_EQ(ortung_set_motion(robot, nullptr, 2), 0);
  EXPECT_EQ(trouble(), "command is NULL");
  EXPECT_EQ(ortung_set_manipulator(robot, nullptr, "up"), 0);
  EXPECT_EQ(trouble(), "manipulator is NULL");
  EXPECT_EQ(ortung_set_manipulator(robot, "arm", nullptr), 0);
  EXPECT_EQ(trouble(), "state is NULL");
  EXPECT_EQ(ortung_read(robot, nullptr, nullptr, 0, nullptr), -1);
  EXPECT_EQ(trouble(), "feature is NULL");
  EXPECT_EQ(ortung_read(robot, "*/LRF/*", nullptr, 1, nullptr), -1);
  EXPECT_EQ(trouble(), "words is NULL");
  EXPECT_EQ(ortung_wait_for_update(robot, kNan), 0);
  EXPECT_EQ(trouble(), "the timeout is not a number");
  EXPECT_EQ(ortung_read(robot, "*/odometry/*", nullptr, 0, nullptr), -1);  // nothing read yet
  EXPECT_EQ(trouble(), "");
  // Pose and velocities; once the first cycle is over, what the drive says follows.
  EXPECT_TRUE(comesTrue("odometry has five words or more", [&] {
    return ortung_update(robot) == 1 &&
           ortung_read(robot, "*/odometry/*", nullptr, 0, nullptr) >= 5;
  }));
  ortung_disconnect(robot);
}

}  // namespace
}  // namespace ortung::test
