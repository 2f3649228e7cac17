// Texts that other programs read, or a later version of ours: each as it was when it was new.
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "EstimatesText.hpp"
#include "Golden.hpp"
#include "MotionToml.hpp"
#include "RunResult.hpp"
#include "ortung/run/Robot.hpp"

namespace ortung::app {
namespace {

using test::expectGolden;
using test::goldenFile;

/// Numbers whose digits are all different, so that none can take another's place.
RunResult numberedRun() {
  RunResult run;
  run.figures.source = "record:a \"b\" \xC3\xA4.rec";
  run.figures.steps = 601;
  run.figures.atCorrections.compared = 602;
  run.figures.overTime.compared = 5999;
  run.figures.duration = 60.25;
  run.figures.convergedDistance = 1.75;
  run.figures.particlesMean = 1234.5;
  run.figures.overTime.positionRmse = 0.125;
  run.figures.overTime.positionMedian = 0.0625;
  run.figures.overTime.positionP95 = 0.375;
  run.figures.overTime.positionP99 = 0.4375;
  run.figures.overTime.positionMax = 0.9375;
  run.figures.overTime.headingRmse = 0.5;
  run.figures.overTime.lostShare = 0.03125;
  run.figures.updateMsP50 = 0.25;
  run.figures.updateMsP99 = 0.75;
  run.figures.updateMsMax = 8.5;
  run.figures.realtimeFactor = std::numeric_limits<double>::infinity();
  run.figures.overTime.neesMean = 2.875;
  run.figures.overTime.neesAboveShare = 0.0078125;
  run.figures.atCorrections.positionRmse = 0.1171875;
  run.figures.atCorrections.positionMedian = 0.046875;
  run.figures.atCorrections.positionP95 = 0.34375;
  run.figures.atCorrections.headingRmse = 0.4375;
  run.figures.atCorrections.lostShare = 0.015625;
  run.figures.atCorrections.neesMean = 2.625;
  run.seed = std::numeric_limits<std::uint64_t>::max();
  run.particles = 20000;
  run.robot = "robot.toml";
  run.start = "truth";
  run.tables = "hall.ortung";
  run.tableInfo.world = "hall";
  return run;
}

TEST(GoldenTexts, FiguresOfARun) { expectGolden("result-5.json", toJson(numberedRun())); }

TEST(GoldenTexts, FiguresOfARunHaveAllKeysThatTheyEverHad) {
  const auto now = nlohmann::json::parse(toJson(numberedRun()));
  for (const char* file : {"result.json", "result-2.json", "result-3.json", "result-4.json"}) {
    const auto old = nlohmann::json::parse(test::readBytes(goldenFile(file)));
    for (const auto& [key, value] : old.items()) EXPECT_TRUE(now.contains(key)) << key;
  }
}

TEST(GoldenTexts, EstimatesOfPoses) {
  PoseEstimate estimate;
  std::string text(kEstimatesHeader);
  appendEstimate(estimate, text);
  estimate.stamp = -1500000;
  estimate.pose = {1.23456, -2.5, -3.14159265};
  estimate.covariance = {1e-4, 2e-7, 3, 4, 5e10, 6, 7, 8, 0.09};
  estimate.share = 0.98765;
  estimate.samples = 100000;
  appendEstimate(estimate, text);
  expectGolden("estimates.txt", text);

  text = "";
  appendEstimate(estimate, 2.0625, text);
  appendEstimate(estimate, std::nullopt, text);
  expectGolden("estimates-at-even-times.txt", text);

  text = "";
  estimate.protection = {0.0125, 0.25};
  estimate.smooth = {1.25, -2.5, -3.125};
  estimate.relocalizations = 7;
  estimate.relocalization = Relocalization::kOtherPlace;
  appendEstimateJson(estimate, 2.0625, {}, text);
  estimate.protection = kUnbounded;
  estimate.covariance[0] = std::numeric_limits<double>::infinity();
  appendEstimateJson(estimate, std::nullopt, {}, text);
  expectGolden("estimates.json", text);

  // On a floor of a building.
  text = "";
  estimate.pose = {31.5, -2.0, 0.25};
  Building building;
  building.floors = {{"ground", 0.0, -5.0, 20.0}, {"first", 30.0, 20.0, 50.0}};
  appendEstimateJson(estimate, std::nullopt, building, text);
  EXPECT_NE(text.find(R"("floor":"first","floor_pose":[1.5,-2.0,0.25]})"), std::string::npos)
      << text;
}

Parameters learnedSettings() {
  Parameters settings("test");
  for (const auto& [key, value] : std::vector<std::pair<std::string, double>>{
           {"turn_per_turn", 0.001},  // less than a filter needs
           {"turn_per_m", 0.0625},
           {"way_per_m", 0.03125},
           {"way_per_turn", 0.25},
           {"slip_share", 0.125},
           {"floor_m", 0.002},
           {"floor_deg", 0.5},
           {"way_scale", 1.062},
           {"turn_scale", 0.9688},
           {"turn_bias_deg_per_m", -1.5},
           {"way_bias_m_per_rad", 0.0},
           {"delay_s", -0.04}})
    settings.set(key, value);
  return settings;
}

TEST(GoldenTexts, LearnedMotionIsWrittenAsItWas) {
  LearnedMotion learned;
  learned.pairs = 1234;
  learned.metres = 56.4;
  learned.radians = 7.6;
  Parameters base("test");
  base.set("plugin", std::string("odometry"));
  expectGolden("motion1.toml",
               motionToml({"record:run.rec", "two\nlines.rec"}, learned, base, learnedSettings()));
}

TEST(GoldenTexts, LearnedMotionIsReadAsItWas) {
  PluginFactory factory(PluginFactory::standardFolders());
  const auto model = makeMotion(readMotionFile(goldenFile("motion1.toml")), factory);
  const Parameters read = model->settings();
  const Parameters expected = learnedSettings();
  for (const std::string& key : read.keys()) {
    if (key == "turn_per_turn") {
      EXPECT_NEAR(read.number(key), 0.1, 1e-12);
    } else {
      EXPECT_NEAR(read.number(key), expected.number(key), 1e-12) << key;
    }
  }
  EXPECT_GE(read.keys().size(), 11u);
  EXPECT_NEAR(model->delay(), -0.04, 1e-12);
}

}  // namespace
}  // namespace ortung::app
