// What amcl's parameters mean: files of Nav2 as they are, and each value that they may have.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "../support/Files.hpp"
#include "AmclParameters.hpp"
#include "ParamsFile.hpp"
#include "Paths.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/mcl/MclConfig.hpp"
#include "ortung/robot/RobotFile.hpp"

namespace ortung::ros2 {
namespace {

using Value = AmclParameters::Value;
using Kind = AmclParameters::Description::Kind;

std::filesystem::path ownFile() {
  return std::filesystem::path(ORTUNG_SOURCE_DIR) / "tests/ros2_live/nav2_params.yaml";
}

AmclParameters read(const std::filesystem::path& file, const RosNames& names) {
  AmclParameters parameters;
  for (const auto& [name, text, isForAll] : readParamsFile(file, names))
    parameters.setText(name, text);
  return parameters;
}

TEST(AmclParameters, TakesAFileOfNav2AsItIs) {
  const AmclParameters parameters = read(ownFile(), {.node = "amcl"});
  const AmclSettings settings = parameters.settings();
  EXPECT_EQ(settings.base, "base_link");
  EXPECT_EQ(settings.scanTopic, "scan");
  EXPECT_EQ(settings.robotToml, "") << "amcl's defaults say nothing of a robot";
  EXPECT_FALSE(settings.initialPose);
  EXPECT_DOUBLE_EQ(settings.transformTolerance, 1.0);
  EXPECT_DOUBLE_EQ(settings.maxRange, 0.0);
  // Each key of the file either counts, or is named with a reason.
  const std::string all = parameters.remark(false);
  EXPECT_EQ(all.find('\n'), all.npos) << "one line for all of them";
  for (const char* name :
       {"sigma_hit", "max_beams", "use_sim_time", "alpha1", "pf_err", "alpha5"}) {
    EXPECT_NE(all.find(name), all.npos) << name << " in\n" << all;
    EXPECT_EQ(all.find(name), all.rfind(name)) << name << " twice in\n" << all;
  }
  for (const char* name : {"base_frame_id", "transform_tolerance", "scan_topic", "tf_broadcast"})
    EXPECT_EQ(all.find(name), all.npos) << name << " in\n" << all;
  EXPECT_NE(parameters.remark(true).find("the robot file tells it"), std::string::npos);
  EXPECT_EQ(AmclParameters().remark(false), "");
}

TEST(AmclParameters, MeanWhatTheyMeanInAmcl) {
  AmclParameters parameters;
  for (const auto& [name, text, isForAll] : ParameterTexts{{"alpha1", "0.08"},
                                                           {"alpha2", "0.04"},
                                                           {"alpha3", "0.01"},
                                                           {"alpha4", "0.02"},
                                                           {"update_min_d", "0.1"},
                                                           {"update_min_a", "0.5"},
                                                           {"max_particles", "3000"},
                                                           {"set_initial_pose", "True"},
                                                           {"initial_pose.x", "1"},
                                                           {"initial_pose.yaw", "7.0"},
                                                           {"laser_max_range", "12.5"},
                                                           {"random_seed", "42"},
                                                           {"save_pose_rate", "0.25"},
                                                           {"tf_broadcast", "false"}})
    parameters.setText(name, text);
  const AmclSettings settings = parameters.settings();
  ASSERT_TRUE(settings.initialPose);
  EXPECT_DOUBLE_EQ(settings.initialPose->x, 1.0);
  EXPECT_NEAR(settings.initialPose->theta, 7.0 - 2.0 * M_PI, 1e-12);
  EXPECT_DOUBLE_EQ(settings.maxRange, 12.5);
  EXPECT_EQ(settings.seed, 42U);
  EXPECT_DOUBLE_EQ(settings.saveSeconds, 4.0);
  EXPECT_FALSE(settings.tellsTransform);
  std::istringstream lines(settings.robotToml);
  std::map<std::string, double> found;
  for (std::string line; std::getline(lines, line);)
    if (const auto at = line.find(" = "); at != line.npos && line[at + 3] != '"')
      found[line.substr(0, at)] = std::stod(line.substr(at + 3));
  // Ten steps of 0.1 m, of which each has the variance alpha2 (0.1 m)^2.
  EXPECT_NEAR(found.at("turn_per_m"), std::sqrt(10 * 0.04 * 0.01), 1e-9);
  EXPECT_NEAR(found.at("way_per_m"), std::sqrt(10 * 0.01 * 0.01), 1e-9);
  EXPECT_NEAR(found.at("turn_per_turn"), std::sqrt(2 * 0.08 * 0.25), 1e-9);
  EXPECT_NEAR(found.at("way_per_turn"), std::sqrt(2 * 0.02 * 0.25), 1e-9);
  EXPECT_NEAR(found.at("min_rotation_deg"), 0.5 / kDegree, 1e-6);
  EXPECT_EQ(found.at("particles"), 3000);
  EXPECT_FALSE(found.contains("min_particles"));
}

TEST(AmclParameters, RefusesWhatAmclHasNot) {
  AmclParameters parameters;
  const auto why = [&](const std::string& name, const std::string& text) -> std::string {
    try {
      parameters.setText(name, text);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(why("max_partikels", "5").find("max_particles"), std::string::npos);
  EXPECT_NE(why("max_particles", "many").find("expected a whole number"), std::string::npos);
  EXPECT_NE(why("max_particles", "1.5").find("expected a whole number"), std::string::npos);
  EXPECT_NE(why("alpha1", "[0.1, 0.2]").find("expected a number"), std::string::npos);
  EXPECT_NE(why("alpha1", "-0.1").find("expected 0 to 100"), std::string::npos);
  EXPECT_NE(why("alpha1", ".nan").find("expected 0 to 100"), std::string::npos);
  EXPECT_NE(why("tf_broadcast", "1").find("expected true or false"), std::string::npos);
  EXPECT_NE(why("base_frame_id", "\"a\\nb\"").find("several lines"), std::string::npos);
  EXPECT_NE(why("robot_model_type", "stationary").find("OmniMotionModel"), std::string::npos);
  EXPECT_EQ(why("robot_model_type", "omnidirectional"), "") << "as it was called before";
  EXPECT_EQ(why("alpha1", "1"), "") << "a whole number is a number";
  EXPECT_EQ(why("qos_overrides./tf.publisher.depth", "7"), "") << "of any node";
  EXPECT_EQ(parameters.get("max_particles"), Value(std::int64_t{2000})) << "unchanged";
}

TEST(AmclParameters, AreFoundByName) {
  for (const auto& one : AmclParameters::all()) {
    ASSERT_NE(AmclParameters::find(one.name), nullptr);
    EXPECT_EQ(AmclParameters::find(one.name)->name, one.name);
    EXPECT_NO_THROW(AmclParameters::check(std::string(one.name), one.byDefault)) << one.name;
    EXPECT_FALSE(one.effect.empty());
  }
  EXPECT_EQ(AmclParameters::find("zz"), nullptr);
  EXPECT_EQ(AmclParameters::find(""), nullptr);
}

/// Any value that a parameter takes makes a robot file that can be read.
RC_GTEST_PROP(AmclParametersProperty, MakeRobotFiles, ()) {
  AmclParameters parameters;
  for (const auto& one : AmclParameters::all()) {
    if (one.kind == Kind::kNone || !*rc::gen::arbitrary<bool>()) continue;
    const double share = *rc::gen::inRange(0, 1001) / 1000.0;
    const double number = one.least + share * (one.most - one.least);
    if (std::holds_alternative<double>(one.byDefault))
      parameters.set(std::string(one.name), number);
    else if (std::holds_alternative<std::int64_t>(one.byDefault))
      parameters.set(std::string(one.name), static_cast<std::int64_t>(number));
    else if (std::holds_alternative<bool>(one.byDefault))
      parameters.set(std::string(one.name), *rc::gen::arbitrary<bool>());
  }
  if (*rc::gen::arbitrary<bool>())
    parameters.set("robot_model_type", std::string("nav2_amcl::OmniMotionModel"));
  const test::TemporaryFolder folder;
  const auto file = folder / "robot.toml";
  std::ofstream(file) << "[robot]\nname = \"r\"\n[[sensor]]\nplugin = \"odometry\"\n"
                      << parameters.settings().robotToml;
  const RobotConfig robot = readRobot(file);
  MclConfig::read(robot.mcl).check();
  // [motion] is read by its plugin; its keys are those of odometry's noise.
  std::istringstream lines(parameters.settings().robotToml);
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("turn_per_") || line.starts_with("way_per_"))
      RC_ASSERT(std::stod(line.substr(line.find('=') + 1)) <= 100.0);
}

}  // namespace
}  // namespace ortung::ros2
