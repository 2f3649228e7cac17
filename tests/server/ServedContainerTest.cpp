// A running robot on the message board: somebody fills its container, clients watch and command it.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <mutex>

#include "Await.hpp"
#include "Files.hpp"
#include "RunningBoard.hpp"
#include "TestClient.hpp"
#include "ortung/core/ReadingLine.hpp"
#include "ortung/formats/ScalarData.hpp"
#include "ortung/server/ServedContainer.hpp"

namespace ortung::test {
namespace {

const SensorId kNear{"sonar", "range", "near"};
const SensorId kFar{"sonar", "range", "far"};

/// The motors of a robot: what they were told.
class Motors : public RobotCommands {
 public:
  ~Motors() override = default;
  void setTranslationalVelocity(double v) override { note("v", v); }
  void setRotationalVelocity(double w) override { note("w", w); }
  void setMotion(std::span<const double> command) override {
    if (command.size() != 2) throw std::invalid_argument("robot rover has two wheels");
    note("wheels", command[0]);
  }
  void setManipulator(std::string_view name, std::string_view) override {
    throw std::invalid_argument("robot rover has no manipulator '" + std::string(name) + "'");
  }
  std::string told() const {
    const std::lock_guard lock(mutex_);
    return told_;
  }

 private:
  void note(const std::string& what, double value) {
    const std::lock_guard lock(mutex_);
    told_ += what + std::to_string(std::lround(value * 10.0)) + " ";
  }
  mutable std::mutex mutex_;
  std::string told_;
};

/// A robot whose clock the test sets.
class ServedContainerTest : public testing::Test {
 protected:
  ServedContainerTest() {
    container_.add(std::make_unique<ScalarData>(kNear, Pose2{}, ScalarData::Config{}));
    container_.add(std::make_unique<ScalarData>(kFar, Pose2{0.2, 0.0, 1.0}, ScalarData::Config{}));
    config_.control = {"olga"};
  }
  std::unique_ptr<ServedContainer> served(RobotCommands* commands = nullptr) {
    ServedContainer::Config config;
    config.robot = "rover";
    config.period = 0.002;
    config.abilities = {"drive v of left and right wheel [m/s]"};
    return std::make_unique<ServedContainer>(
        container_, [this] { return clock_.load(); }, config, commands);
  }
  void sense(const SensorId& id, Timestamp stamp, std::uint32_t word) {
    clock_ = stamp;
    ASSERT_TRUE(container_.set(Message{stamp, id, {word}}));
  }

  SensorContainer container_;
  std::atomic<Timestamp> clock_{5'000'000};
  BoardConfig config_;
  Motors motors_;
};

/// The reading that a client gets of a query, once there is one.
std::string readingOf(TestClient& client, const std::string& query) {
  EXPECT_TRUE(comesTrue("there is a reading of " + query,
                        [&] { return valueOf(client.ask("READ " + query), "lines") == "1"; }));
  return client.line();
}

TEST_F(ServedContainerTest, ClientsListDescribeAndReadTheRobot) {
  const auto world = served();
  sense(kNear, 5'000'000, 1200);
  const RunningBoard board(*world, config_);
  TestClient client(board.port());
  const std::string hello = client.ask("HELLO ortung/1 name=anna");
  EXPECT_EQ(valueOf(hello, "kind"), "robot");
  EXPECT_EQ(valueOf(hello, "world"), "rover");
  EXPECT_EQ(valueOf(hello, "state"), "running");
  EXPECT_EQ(client.ask("LIST robots"), "OK LIST lines=1");
  EXPECT_EQ(client.line(), "robot=1 name=rover client=0");
  EXPECT_EQ(client.ask("DESCRIBE robot"), "OK DESCRIBE lines=7");
  EXPECT_TRUE(client.line().starts_with("sonar/range/near "));
  EXPECT_TRUE(client.line().starts_with("sonar/range/far "));
  EXPECT_EQ(client.line(), "format sonar/range/near range max_m=20");
  EXPECT_EQ(client.line(), "format sonar/range/far range max_m=20");
  EXPECT_EQ(client.line(), "mount sonar/range/near x_m=0 y_m=0 theta_rad=0");
  EXPECT_EQ(client.line(), "mount sonar/range/far x_m=0.2 y_m=0 theta_rad=1");
  EXPECT_EQ(client.line(), "drive v of left and right wheel [m/s]");
  EXPECT_EQ(readingOf(client, "*/*/near"), "5000000 sonar/range/near 1 1200");
  EXPECT_EQ(valueOf(client.ask("READ */*/far"), "lines"), "0");
  sense(kFar, 5'100'000, 7000);
  EXPECT_EQ(readingOf(client, "*/*/far"), "5100000 sonar/range/far 1 7000");
}

TEST_F(ServedContainerTest, TheClockIsTheRobots) {
  const auto world = served();
  const RunningBoard board(*world, config_);
  TestClient client(board.port());
  client.ask("HELLO ortung/1");
  for (const Timestamp stamp : {90'000'000, 1'000'000'000}) {
    clock_ = stamp;
    // It runs on between looks, at most for as long as a look may take to come.
    std::int64_t now = 0;
    EXPECT_TRUE(comesTrue("the clock is that of the robot", [&] {
      now = std::stoll(valueOf(client.ask("TIME"), "sent"));
      return now >= stamp;
    }));
    EXPECT_LT(now, stamp + 10'000'000);
  }
}

TEST_F(ServedContainerTest, SubscribersSeeWhatAnotherThreadFillsIn) {
  const auto world = served();
  const RunningBoard board(*world, config_);
  TestClient client(board.port());
  client.ask("HELLO ortung/1 role=viewer");
  EXPECT_EQ(client.ask("SUBSCRIBE */*/near robot=1"), "OK SUBSCRIBE robot=1");
  std::atomic<bool> isDone{false};
  std::thread filler([&] {
    for (std::uint32_t i = 0; !isDone; ++i) {
      const Timestamp stamp = 5'000'000 + 1000 * static_cast<Timestamp>(i);
      const Message frame[] = {{stamp, kNear, {i}}, {stamp, kFar, {i}}};
      clock_ = stamp;
      container_.set(frame);
    }
  });
  std::uint32_t last = 0;
  for (int seen = 0; seen < 20;) {
    const auto reading = parseLine(client.line());
    if (!reading) continue;  // "* UPDATE ..."
    EXPECT_EQ(reading->stamp, 5'000'000 + 1000 * static_cast<Timestamp>(reading->words[0]));
    EXPECT_TRUE(seen == 0 || reading->words[0] > last);
    last = reading->words[0];
    ++seen;
  }
  isDone = true;
  filler.join();
}

TEST_F(ServedContainerTest, OperatorsCommandItAndItStopsWhenTheyLeave) {
  const auto world = served(&motors_);
  const RunningBoard board(*world, config_);
  TestClient anna(board.port());
  anna.ask("HELLO ortung/1 name=anna");
  EXPECT_EQ(anna.ask("VELOCITY v_m_s=1"),
            "ERR role commanding a running robot needs the role operator");
  {
    TestClient olga(board.port());
    olga.ask("HELLO ortung/1 name=olga");
    EXPECT_EQ(olga.ask("VELOCITY v_m_s=0.5 w_rad_s=-0.2"), "OK VELOCITY");
    EXPECT_EQ(olga.ask("MOTION 0.1 0.1 robot=1"), "OK MOTION");
    EXPECT_EQ(olga.ask("MOTION 1"), "ERR number robot rover has two wheels");
    EXPECT_EQ(olga.ask("MANIPULATOR arm up"),
              "ERR no-manipulator robot rover has no manipulator 'arm'");
    EXPECT_EQ(olga.ask("VELOCITY v_m_s=1 robot=2"), "ERR no-robot there is no robot 2");
    EXPECT_EQ(motors_.told(), "v5 w-2 wheels1 ");
    olga.kill();
  }
  EXPECT_TRUE(comesTrue("the operator has left",
                        [&] { return valueOf(anna.ask("STATUS"), "clients") == "1"; }));
  EXPECT_EQ(motors_.told(), "v5 w-2 wheels1 v0 w0 ");
}

TEST_F(ServedContainerTest, ItStopsWhenTheServerEnds) {
  const auto world = served(&motors_);
  {
    const RunningBoard board(*world, config_);
    TestClient olga(board.port());
    olga.ask("HELLO ortung/1 name=olga");
    EXPECT_EQ(olga.ask("VELOCITY v_m_s=0.5"), "OK VELOCITY");
    EXPECT_EQ(motors_.told(), "v5 ");
  }
  EXPECT_EQ(motors_.told(), "v5 v0 w0 ");
}

TEST_F(ServedContainerTest, WithoutCommandsNobodyCommandsIt) {
  const auto world = served();
  const RunningBoard board(*world, config_);
  TestClient olga(board.port());
  olga.ask("HELLO ortung/1 name=olga");
  EXPECT_EQ(olga.ask("VELOCITY v_m_s=1"),
            "ERR live this is a running robot: it takes no commands from clients");
}

TEST_F(ServedContainerTest, WhatMakesNoSenseWithARunningRobotIsRefused) {
  const auto world = served(&motors_);
  const RunningBoard board(*world, config_);
  TestClient olga(board.port());
  olga.ask("HELLO ortung/1 name=olga");
  for (const char* line : {"PAUSE", "RESUME", "STEP", "SPEED 2", "RESET", "LOCKSTEP on",
                           "PLACE robot=1 x_m=0 y_m=0", "PLACE object=ball x_m=0 y_m=0"})
    EXPECT_TRUE(olga.ask(line).starts_with("ERR live this is a running robot: ")) << line;
  olga.send("CREATE mine\n[[sensor]]\nplugin = \"lrf\"\n");
  EXPECT_EQ(olga.ask("."), "ERR live this is a running robot: no other can join it");
  EXPECT_EQ(olga.ask("REMOVE robot=1"), "ERR not-yours robot 1 belongs to the world");
  EXPECT_TRUE(olga.ask("NEXT").starts_with("ERR state"));
  EXPECT_EQ(valueOf(olga.ask("STATUS"), "state"), "running");
}

TEST_F(ServedContainerTest, ConfigurationsThatMakeNoSenseAreRefused) {
  ServedContainer::Config config;
  const auto clock = [] { return Timestamp{0}; };
  EXPECT_THROW(ServedContainer(container_, {}, config), std::invalid_argument);
  config.period = 0.0;
  EXPECT_THROW(ServedContainer(container_, clock, config), std::invalid_argument);
  config = {};
  config.robot = "my robot";
  EXPECT_THROW(ServedContainer(container_, clock, config), std::invalid_argument);
  const auto world = served();
  for (const Pace pace : {Pace::kFree, Pace::kLockstep}) {
    config_.pace = pace;
    EXPECT_EQ(messageOf<std::invalid_argument>([&] { MessageBoard(*world, config_); }),
              "a running robot is served in real time, at speed 1");
  }
}

}  // namespace
}  // namespace ortung::test
