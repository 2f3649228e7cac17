#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "ortung/base/Parameters.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/motion/MotionNetwork.hpp"
#include "ortung/robot/MotionNetworkFile.hpp"

namespace ortung {
namespace {

/// One command, one hidden layer of one neuron that looks at v_t and at the commanded v_t.
MotionNetwork small() {
  MotionNetwork n;
  n.step = 0.5;
  n.commands = 1;
  n.limit = {2.0, 3.0};
  n.inputMean = {0.1, 0.0, 0.2, 0.0};
  n.inputScale = {2.0, 1.0, 4.0, 1.0};
  n.outputScale = {0.1, 0.2, 0.3, 0.4, 0.5};
  n.layers = {{4, 1, {0.5, 0.0, -0.25, 1.0}, {0.125}},
              {1, 5, {1, 2, 3, 4, 5}, {0, 0.1, 0, 0, -0.1}}};
  return n;
}

// By hand: inputs (0.6, 0.3, 0.7, -0.2) become (1, 0.3, 2, -0.2); the neuron sees
// 0.5 - 0.5 - 0.2 + 0.125 = -0.075 and says t = tanh(-0.075).
TEST(MotionNetwork, SaysWhatAHandSays) {
  const MotionNetwork n = small();
  n.check();
  const Velocities command{0.7, -0.2};
  const MotionNetwork::Prediction p = n.predict({0.6, 0.3}, {&command, 1});
  const double t = std::tanh(-0.075);
  EXPECT_NEAR(p.change.x, 0.6 * 0.5 + 0.1 * t, 1e-12);
  EXPECT_NEAR(p.change.y, 0.2 * (2 * t + 0.1), 1e-12);
  EXPECT_NEAR(p.change.theta, 0.3 * 0.5 + 0.3 * 3 * t, 1e-12);
  EXPECT_NEAR(p.velocity.translational, 0.6 + 0.4 * 4 * t, 1e-12);
  EXPECT_NEAR(p.velocity.rotational, 0.3 + 0.5 * (5 * t - 0.1), 1e-12);
}

TEST(MotionNetwork, NeverLeavesItsLimits) {
  MotionNetwork n = small();
  n.outputScale = {1e5, 1e5, 1e5, 1e5, 1e5};
  NeuralRobot robot(n);
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const Pose2 change = robot.step({random.uniform(-1e3, 1e3), random.uniform(-1e3, 1e3)});
    ASSERT_LE(std::abs(change.x), 1.0);  // 2 m/s for 0.5 s
    ASSERT_LE(std::abs(robot.velocity().translational), 2.0);
    ASSERT_LE(std::abs(robot.velocity().rotational), 3.0);
  }
}

TEST(MotionNetwork, SeesTheNewestCommandsFirst) {
  MotionNetwork n = small();
  n.commands = 2;
  n.inputMean.assign(6, 0.0);
  n.inputScale.assign(6, 1.0);
  n.outputScale.assign(5, 1.0);
  n.layers = {{6, 5, std::vector<double>(30, 0.0), std::vector<double>(5, 0.0)}};
  n.layers[0].weights[2] = 1.0;   // x: the newest commanded v_t
  n.layers[0].weights[10] = 1.0;  // y: the one before
  NeuralRobot robot(n);
  robot.step({0.25, 0});
  const Pose2 change = robot.step({0.5, 0});
  EXPECT_EQ(change.x, 0.5);
  EXPECT_EQ(change.y, 0.25);
  robot.reset();
  EXPECT_EQ(robot.step({0, 0}).y, 0.0);
}

TEST(MotionNetwork, IsTheSameAfterAFile) {
  MotionNetwork n = small();
  n.fromVelocities = true;
  n.layers[0].weights[1] = 1.0 / 3.0;
  const MotionNetwork again = parseMotionNetwork(toJson(n), "net.json");
  EXPECT_EQ(again.layers[0].weights, n.layers[0].weights);
  EXPECT_EQ(again.inputScale, n.inputScale);
  EXPECT_EQ(again.fromVelocities, true);
  EXPECT_EQ(toJson(again), toJson(n));
}

std::string messageOf(const std::string& text) {
  try {
    parseMotionNetwork(text, "net.json");
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

TEST(MotionNetwork, RefusesAWrongShape) {
  const auto with = [](const auto& change) {
    MotionNetwork n = small();
    change(n);
    return messageOf(toJson(n));
  };
  EXPECT_EQ(with([](MotionNetwork& n) { n.layers[1].weights.pop_back(); }),
            "net.json: layer 1: weights is 4 numbers, expected 5");
  EXPECT_EQ(with([](MotionNetwork& n) { n.layers.pop_back(); }),
            "net.json: layer 0 is 1 outputs wide, expected 5");
  EXPECT_EQ(with([](MotionNetwork& n) { n.commands = 2; }),
            "net.json: input_mean is 4 numbers, expected 6");
  EXPECT_EQ(with([](MotionNetwork& n) { n.layers[1].inputs = 2; }),
            "net.json: layer 1 is 2 inputs wide, expected 1");
  EXPECT_EQ(with([](MotionNetwork& n) { n.layers.clear(); }),
            "net.json: layers is 0, expected 1 to 8");
  // Nine that fit each other but for their number.
  EXPECT_EQ(with([](MotionNetwork& n) {
              n.layers.insert(n.layers.begin() + 1, 7, {1, 1, {0.5}, {0.0}});
            }),
            "net.json: layers is 9, expected 1 to 8");
  for (const auto& change : std::vector<std::function<void(MotionNetwork&)>>{
           [](MotionNetwork& n) { n.commands = 0; }, [](MotionNetwork& n) { n.commands = 65; },
           [](MotionNetwork& n) { n.step = 0.0; },
           [](MotionNetwork& n) { n.limit.rotational = -1; },
           [](MotionNetwork& n) { n.inputScale[0] = 0.0; },
           [](MotionNetwork& n) { n.layers[0].bias[0] = 1e9; },
           [](MotionNetwork& n) { n.layers[0].bias[0] = std::nan(""); },  // null in the file
           [](MotionNetwork& n) { n.layers.resize(9, n.layers[0]); }}) {
    EXPECT_TRUE(with(change).starts_with("net.json: ")) << with(change);
  }
}

TEST(MotionNetwork, RefusesWhatIsNoNetwork) {
  const std::string good = toJson(small());
  for (std::size_t length = 0; length + 2 < good.size(); length += 7) {
    EXPECT_TRUE(messageOf(good.substr(0, length)).starts_with("net.json: "))
        << length;  // truncated
  }
  for (const char* text : {"", "[]", "{}", "7", "{\"format\": 1}", "\xff\xfe",
                           "{\"format\": \"ortung motion network 2\"}"}) {
    EXPECT_TRUE(messageOf(text).starts_with("net.json: ")) << text;
  }
  EXPECT_TRUE(messageOf(std::string(100000, '[')).starts_with("net.json: is "));
  EXPECT_EQ(messageOf(std::string(5U << 20, ' ')),
            "net.json: is larger than 4 MiB, expected a motion network");
  EXPECT_THROW(readMotionNetwork("/nowhere/net.json"), ConfigError);
  EXPECT_THROW(readMotionNetwork("/"), ConfigError);
}

TEST(MotionNetwork, SurvivesMutatedFiles) {
  const std::string good = toJson(small());
  Random random(3);
  for (int i = 0; i < 3000; ++i) {
    std::string text = good;
    for (int k = 0; k < 3; ++k)
      text[random.below(text.size())] = static_cast<char>(random.below(256));
    try {
      parseMotionNetwork(text, "net.json").check();
    } catch (const ConfigError&) {  // refused
    }
  }
}

}  // namespace
}  // namespace ortung
