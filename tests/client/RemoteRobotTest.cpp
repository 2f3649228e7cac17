#include <gtest/gtest.h>

#include <condition_variable>
#include <mutex>
#include <optional>

#include "../server/RunningBoard.hpp"
#include "Await.hpp"
#include "Files.hpp"
#include "Paths.hpp"
#include "ortung/client/RemoteRobot.hpp"
#include "ortung/client/ortung_client.h"
#include "ortung/formats/OdometryData.hpp"
#include "ortung/formats/ScanData.hpp"
#include "ortung/served/ServedSimulation.hpp"

namespace ortung::test {
namespace {

const std::string kWorld = ORTUNG_SOURCE_DIR "/maps/fields/arena.toml";
const std::string kRobot = ORTUNG_SOURCE_DIR "/maps/robots/pioneer.toml";

BoardConfig onPort(std::uint16_t port, Pace pace = Pace::kRealTime) {
  BoardConfig config;
  config.port = port;
  config.pace = pace;
  return config;
}

RemoteOptions to(std::uint16_t port) {
  RemoteOptions options;
  options.session.port = port;
  options.cycle = 0.01;
  return options;
}

TEST(RemoteRobot, TheContainerFillsItselfAndTheRobotMoves) {
  ServedSimulation world(kWorld, {.noise = false});
  BoardConfig config = onPort(0);
  config.speed = 10.0;
  const RunningBoard board(world, config);
  RemoteRobot robot(kRobot, to(board.port()));
  EXPECT_TRUE(robot.isConnected());
  robot.setRotationalVelocity(1.0);
  const auto turned = [&] {
    const auto odometry = robot.container().get<OdometryData>({.type = "odometry"});
    return odometry && std::abs(odometry->pose.theta) > 0.2;
  };
  ASSERT_TRUE(comesTrue("it has turned", [&] { return robot.waitForUpdate(20.0) && turned(); }))
      << robot.trouble();
  const auto scan = robot.container().get<ScanData>({.type = "LRF"});
  ASSERT_TRUE(scan.has_value());
  EXPECT_EQ(robot.trouble(), "");
}

TEST(RemoteRobot, StampsAreThoseOfTheClientsClock) {
  ServedSimulation world(kWorld, {});
  const RunningBoard board(world, onPort(0));
  RemoteOptions options = to(board.port());
  options.cycle = 0.0;
  // A clock that is a day ahead.
  constexpr Timestamp kDay = 86'400'000'000;
  const auto clock = [] {
    return kDay + std::chrono::duration_cast<std::chrono::microseconds>(
                      std::chrono::steady_clock::now().time_since_epoch())
                      .count();
  };
  options.clock = clock;
  const Timestamp before = clock();
  RemoteRobot robot(kRobot, options);
  const SensorData* odometry = robot.container().find({.type = "odometry"});
  ASSERT_TRUE(comesTrue("there is a reading", [&] {
    return robot.update() && odometry->sequence() > 0;
  })) << robot.trouble();
  const ClockOffset offset = robot.clockOffset();
  const double bound = offset.bound(0);
  const auto lock = robot.container().read();
  EXPECT_GT(odometry->stamp(), before - fromSeconds(1.0));  // it was sensed about now
  EXPECT_LT(static_cast<double>(odometry->stamp()), static_cast<double>(clock()) + bound);
}

TEST(RemoteRobot, WhatTheServerRefusesIsTold) {
  ServedSimulation world(kWorld, {});
  const RunningBoard board(world, onPort(0));
  RemoteRobot robot(kRobot, to(board.port()));
  EXPECT_THROW(robot.setMotion(std::vector<double>(9)), std::invalid_argument);
  EXPECT_THROW(robot.setManipulator("arm", "up"), std::invalid_argument);
  EXPECT_NE(robot.trouble().find("no manipulator 'arm'"), std::string::npos) << robot.trouble();
  EXPECT_TRUE(robot.isConnected());

  RemoteOptions options = to(board.port());
  options.session.start = Pose2{100.0, 0.0, 0.0};
  EXPECT_THROW(RemoteRobot(kRobot, options), ServerRefused);
}

TEST(RemoteRobot, AServerThatDiesIsToldAndFoundAgain) {
  ServedSimulation world(kWorld, {});
  auto board = std::make_unique<RunningBoard>(world, onPort(0));
  const std::uint16_t port = board->port();
  std::mutex mutex;
  std::vector<std::string> told;
  RemoteOptions options = to(port);
  options.onTrouble = [&](const std::string& text) {
    const std::lock_guard lock(mutex);
    told.push_back(text);
  };
  RemoteRobot robot(kRobot, options);
  ASSERT_TRUE(robot.waitForUpdate(20.0));
  board.reset();
  ASSERT_TRUE(comesTrue("it is cut off", [&] { return !robot.isConnected(); }));
  EXPECT_NE(robot.trouble().find("127.0.0.1:" + std::to_string(port)), std::string::npos);
  EXPECT_THROW(robot.setTranslationalVelocity(0.1), ConnectionLost);

  ServedSimulation again(kWorld, {});
  const RunningBoard next(again, onPort(port));
  ASSERT_TRUE(robot.waitForUpdate(20.0)) << robot.trouble();
  EXPECT_TRUE(robot.isConnected());
  robot.setTranslationalVelocity(0.1);
  EXPECT_TRUE(comesTrue("the new connection is told", [&] {
    const std::lock_guard lock(mutex);
    return told.size() >= 2 && told.back().starts_with("connected again");
  }));
}

TEST(RemoteRobot, NobodyListeningIsAnErrorAtOnce) {
  std::uint16_t port = 0;
  {
    ServedSimulation world(kWorld, {});
    const RunningBoard board(world, onPort(0));
    port = board.port();
  }
  const std::string message = messageOf<ConnectionLost>([&] { RemoteRobot(kRobot, to(port)); });
  EXPECT_EQ(message, "127.0.0.1:" + std::to_string(port) + ": can't connect: Connection refused");
}

TEST(RemoteRobot, InLockstepItPlaysCycleByCycle) {
  ServedSimulation world(kWorld, {});
  const RunningBoard board(world, onPort(0, Pace::kLockstep));
  RemoteOptions options = to(board.port());
  options.cycle = 0.0;
  options.hasLocalStamps = false;
  RemoteRobot robot(kRobot, options);
  ASSERT_TRUE(robot.next(11)) << robot.trouble();
  const SensorData* odometry = robot.container().find({.type = "odometry"});
  EXPECT_EQ(odometry->stamp(), 100'000);
  ASSERT_TRUE(robot.next()) << robot.trouble();
  EXPECT_EQ(odometry->stamp(), 100'000);  // every 50 ms
}

TEST(RemoteRobot, ReadingsInBinaryFormAreTheSame) {
  std::vector<std::vector<std::uint32_t>> scans;
  for (const bool isBinary : {false, true}) {
    ServedSimulation world(kWorld, {});
    const RunningBoard board(world, onPort(0, Pace::kLockstep));
    RemoteOptions options = to(board.port());
    options.cycle = 0.0;
    options.session.isBinary = isBinary;
    RemoteRobot robot(kRobot, options);
    robot.setRotationalVelocity(1.0);
    ASSERT_TRUE(robot.next(50)) << robot.trouble();
    ASSERT_TRUE(robot.update()) << robot.trouble();  // nothing is new
    const auto words = robot.container().find({.type = "LRF"})->getData();
    scans.emplace_back(words.begin(), words.end());
  }
  EXPECT_EQ(scans[0].size(), 180u);
  EXPECT_EQ(scans[0], scans[1]);
}

TEST(ClientForC, PlaysTheSame) {
  ServedSimulation world(kWorld, {.noise = false});
  const RunningBoard board(world, onPort(0, Pace::kLockstep));
  char text[256];
  EXPECT_EQ(ortung_connect("127.0.0.1", 1, kRobot.c_str(), "c", nullptr, 0.0, text, sizeof text),
            nullptr);
  EXPECT_STREQ(text, "127.0.0.1:1: can't connect: Connection refused");
  ortung_robot* robot = ortung_connect("127.0.0.1", board.port(), kRobot.c_str(), "c", nullptr, 0.0,
                                       text, sizeof text);
  ASSERT_NE(robot, nullptr) << text;
  std::uint32_t words[200];
  EXPECT_EQ(ortung_read(robot, "*/LRF/*", words, 200, nullptr), -1);  // nothing was sensed yet
  EXPECT_EQ(ortung_set_velocity(robot, 0.2, 0.1), 1);
  EXPECT_EQ(ortung_next(robot, 1), 1);
  std::int64_t stamp = -1;
  EXPECT_EQ(ortung_read(robot, "*/LRF/*", words, 200, &stamp), 180);
  EXPECT_EQ(ortung_read(robot, "*/LRF/*", words, 10, nullptr), 180);
  EXPECT_EQ(ortung_read(robot, "nonsense", words, 10, nullptr), -1);
  EXPECT_EQ(ortung_set_manipulator(robot, "arm", "up"), 0);
  char trouble[20];
  ortung_trouble(robot, trouble, sizeof trouble);
  EXPECT_STREQ(trouble,
               ("127.0.0.1:" + std::to_string(board.port()) + ": the s").substr(0, 19).c_str());
  ortung_disconnect(robot);
}

}  // namespace
}  // namespace ortung::test
