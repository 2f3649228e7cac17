// What a server says of a robot, beside what stands in its robot file.
#include <gtest/gtest.h>

#include <numbers>

#include "../server/RunningBoard.hpp"
#include "Files.hpp"
#include "Paths.hpp"
#include "ScriptedServer.hpp"
#include "ortung/client/RemoteRobot.hpp"
#include "ortung/client/ortung_client.h"
#include "ortung/served/ServedSimulation.hpp"

namespace ortung::test {
namespace {

const std::string kWorld = ORTUNG_SOURCE_DIR "/maps/fields/arena.toml";
constexpr double kDegree = std::numbers::pi / 180.0;

constexpr const char* kRobot = R"([robot]
radius_m = 0.21
mass_kg = 7
[drive]
max_speed_m_s = 0.65
max_turn_deg_s = 110
acceleration_m_s2 = 0.9
turn_acceleration_deg_s2 = 300
body_height_m = 0.33
[[sensor]]
plugin = "odometry"
[[sensor]]
plugin = "lrf"
pose = { x_m = 0.11, y_m = -0.02, z_m = 0.3, theta_deg = 45 }
beams = 5
fov_deg = 180
max_range_m = 8
sigma_m = 0.05
[[manipulator]]
name = "kicker"
[[manipulator.state]]
name = "in"
[[manipulator.state]]
name = "out"
[[manipulator.state.body]]
shape = "rectangle"
center_m = [0.25, 0]
size_m = [0.06, 0.2]
z_m = [0.05, 0.2]
)";

class Described : public testing::Test {
 protected:
  void SetUp() override { writeBytes(file, kRobot); }
  TemporaryFolder folder;
  std::filesystem::path file = folder / "robot.toml";
  ServedSimulation world{kWorld, {}};
  RunningBoard board{world, BoardConfig()};
};

TEST_F(Described, IsWhatTheRobotFileSays) {
  RemoteOptions options;
  options.session.port = board.port();
  options.cycle = 0.0;
  const RemoteRobot robot(file, options);
  const RobotDescription description = robot.description();
  const auto* scan = description.find({.type = "LRF"});
  ASSERT_NE(scan, nullptr);
  ASSERT_TRUE(scan->mount.has_value());
  EXPECT_DOUBLE_EQ(scan->mount->x, 0.11);
  EXPECT_DOUBLE_EQ(scan->mount->y, -0.02);
  EXPECT_NEAR(scan->mount->theta, 45.0 * kDegree, 1e-12);
  EXPECT_FALSE(scan->words.empty());
  EXPECT_EQ(description.find({.type = "camera"}), nullptr);
  EXPECT_DOUBLE_EQ(description.maxTranslationalVelocity.value_or(-1.0), 0.65);
  EXPECT_NEAR(description.maxRotationalVelocity.value_or(-1.0), 110.0 * kDegree, 1e-12);
  EXPECT_DOUBLE_EQ(description.maxTranslationalAcceleration.value_or(-1.0), 0.9);
  EXPECT_NEAR(description.maxRotationalAcceleration.value_or(-1.0), 300.0 * kDegree, 1e-12);
  EXPECT_DOUBLE_EQ(description.radius.value_or(-1.0), 0.21);
  EXPECT_DOUBLE_EQ(description.height.value_or(-1.0), 0.33);
  EXPECT_DOUBLE_EQ(description.mass.value_or(-1.0), 7.0);
  EXPECT_FALSE(description.motion.empty());
  ASSERT_EQ(description.manipulators.size(), 1u);
  EXPECT_EQ(description.manipulators[0].name, "kicker");
  EXPECT_EQ(description.manipulators[0].states, (std::vector<std::string>{"in", "out"}));
}

TEST_F(Described, ToCToo) {
  char text[256];
  ortung_robot* robot =
      ortung_connect("127.0.0.1", board.port(), file.c_str(), "c", nullptr, 0.0, text, sizeof text);
  ASSERT_NE(robot, nullptr) << text;
  double v = 0.0, w = 0.0, x = 0.0, y = 0.0, theta = 0.0;
  EXPECT_EQ(ortung_max_velocity(robot, &v, &w), 1);
  EXPECT_DOUBLE_EQ(v, 0.65);
  EXPECT_NEAR(w, 110.0 * kDegree, 1e-12);
  EXPECT_EQ(ortung_max_velocity(robot, nullptr, nullptr), 1);
  EXPECT_EQ(ortung_mount(robot, "*/LRF/*", &x, &y, &theta), 1);
  EXPECT_DOUBLE_EQ(x, 0.11);
  EXPECT_DOUBLE_EQ(y, -0.02);
  EXPECT_NEAR(theta, 45.0 * kDegree, 1e-12);
  EXPECT_EQ(ortung_mount(robot, "*/camera/*", &x, &y, &theta), 0);
  ortung_trouble(robot, text, sizeof text);
  EXPECT_STREQ(text, "the server does not say where */camera/* is");
  EXPECT_EQ(ortung_mount(robot, nullptr, &x, &y, &theta), 0);
  EXPECT_EQ(ortung_mount(nullptr, "*/LRF/*", &x, &y, &theta), 0);
  EXPECT_EQ(ortung_max_velocity(nullptr, &v, &w), 0);
  ortung_disconnect(robot);
}

TEST(RobotDescription, WhatIsUnknownOrMissingIsPassedOver) {
  const RobotDescription robot = parseRobotDescription(
      {"a/b/c words", "d/e/f", "wings 2", "", "mount a/b/x x_m=1 y_m=1 theta_rad=1",
       "mount d/e/f x_m=1 y_m=2 z_m=3", "limits v_m_s=2 u_m_s=1", "manipulator arm", "body"});
  ASSERT_EQ(robot.features.size(), 2u);
  EXPECT_EQ(robot.features[0].words, "words");
  EXPECT_FALSE(robot.features[0].mount || robot.features[1].mount);
  EXPECT_EQ(robot.maxTranslationalVelocity, 2.0);
  EXPECT_FALSE(robot.maxRotationalVelocity || robot.radius || robot.height || robot.mass);
  ASSERT_EQ(robot.manipulators.size(), 1u);
  EXPECT_TRUE(robot.manipulators[0].states.empty());
}

TEST(RobotDescription, NonsenseIsRefusedWithItsLine) {
  for (const std::string line : {"limits v_m_s=fast", "limits v_m_s=nan", "body radius_m=inf",
                                 "mount a x_m=1", "mount", "a/b words", "a/ /c words"}) {
    EXPECT_EQ(messageOf<std::invalid_argument>([&] { parseRobotDescription({"x/y/z", line}); }),
              line);
    ScriptedServer server([&](const std::string& request) -> std::optional<std::string> {
      return request == "DESCRIBE robot" ? "OK DESCRIBE lines=1\n" + line : "";
    });
    SessionOptions options;
    options.port = server.port();
    RobotSession session(options, "[robot]\n");
    const std::string what = messageOf<ConnectionLost>([&] { session.describe(); });
    EXPECT_NE(what.find("found '" + line + "', which is not ortung/1"), std::string::npos) << what;
  }
}

}  // namespace
}  // namespace ortung::test
