// Noise learned from a record, and bounds beside errors, as a user gets them.
#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "Workspace.hpp"
#include "ortung/robot/RobotFile.hpp"

namespace ortung::test {
namespace {

class CalibrateNoise : public Workspace {
 protected:
  CalibrateNoise() {
    replace("robot.toml", "max_range_m = 8\n",
            "max_range_m = 8  # as its maker says\nnoise_sigma_m = 0.03\nnoise_sigma_per_m = 0\n");
    learnTables();
    recordRun();
  }
  Outcome calibrate(const std::vector<std::string>& more) const {
    std::vector<std::string> arguments = {
        "calibrate",        "noise",    path("run.rec"),    "--robot",
        path("robot.toml"), "--tables", path("hall.ortung")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return ortung(arguments);
  }
  Outcome eval(const std::string& robot, const std::vector<std::string>& more) const {
    std::vector<std::string> arguments = {
        "eval",      "--source", "record:" + path("run.rec"), "--robot",
        path(robot), "--tables", path("hall.ortung"),         "--start",
        "truth"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return ortung(arguments);
  }
};

TEST_F(CalibrateNoise, WritesARobotFileWithTheNoiseThatEvalTakes) {
  const Outcome outcome = calibrate({"--fixed", "mount,latency", "--out", path("learned.toml")});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("LMS200/LRF/180DegreeScan"), std::string::npos);
  EXPECT_NE(read("learned.toml").find("max_range_m = 8  # as its maker says\n"), std::string::npos);
  const Parameters scanner = readRobot(path("learned.toml")).sensors.front().parameters;
  // What tables of 10 cm, 4 degrees and levels of 5 cm add to 3 cm; the file said 7 cm at 2 m.
  const double at2m = scanner.number("sigma_m") + 2 * scanner.number("sigma_per_m");
  EXPECT_GT(at2m, 0.025);
  EXPECT_LT(at2m, 0.05);
  EXPECT_EQ(scanner.number("noise_sigma_m"), 0.03);
  EXPECT_EQ(eval("learned.toml", {}).exitCode, 0);
}

// End-point fields keep no ranges: what is expected are the surfaces that the tables have, too,
// which add next to nothing to 3 cm. The file says 5 cm.
TEST_F(CalibrateNoise, LearnsOfScannersThatAreWeighedByTheirEndPoints) {
  replace("robot.toml", "noise_sigma_m = 0.03\n",
          "noise_sigma_m = 0.03\nperception = \"endpoints\"\nsigma_m = 0.05\n");
  learnTables();
  const Outcome outcome = calibrate({"--fixed", "mount,latency", "--out", path("learned.toml")});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  const Parameters scanner = readRobot(path("learned.toml")).sensors.front().parameters;
  const double at2m = scanner.number("sigma_m") + 2 * scanner.number("sigma_per_m");
  EXPECT_GT(at2m, 0.025);
  EXPECT_LT(at2m, 0.035);
  EXPECT_EQ(eval("learned.toml", {}).exitCode, 0);
}

TEST_F(CalibrateNoise, LearnsAlongItsOwnTrackWhereThereIsNoTruth) {
  const Outcome truth = calibrate({"--reference", "truth"});
  EXPECT_EQ(truth.exitCode, 0) << truth.err;
  std::string text = read("run.rec");
  for (std::size_t at = text.find("groundTruth"); at != text.npos; at = text.find("groundTruth"))
    text.erase(text.rfind('\n', at) + 1, text.find('\n', at) - text.rfind('\n', at));
  write("run.rec", text);
  expectRefused(calibrate({"--reference", "truth"}), 1, "ortung", {"has no ground truth"});
  const Outcome track = calibrate({});
  EXPECT_EQ(track.exitCode, 0) << track.err;
  // Poses of the search for a place are none that readings could be compared with: of three scans
  // the robot is not found yet.
  std::string begin;
  std::istringstream lines(read("run.rec"));
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with('#') || std::stoll(line) <= 250'000) begin += line + "\n";
  write("run.rec", begin);
  expectRefused(calibrate({}), 1, "ortung calibrate noise: record:" + path("run.rec"),
                {"MCL was never tracking, so there is no reference"});
}

// Landmarks in a list have all terms but the mount's heading, which is their bearings' bias, and
// scans have those of ranges alone.
TEST_F(CalibrateNoise, WhatIsFixedIsNotLearned) {
  std::string hall = read("hall.toml");
  int identity = 0;
  for (const std::string place : {"1, 1.8", "-2.5, -1", "2.5, 1.5"})
    hall += "[[landmark]]\nkind = \"post\"\nidentity = " + std::to_string(++identity) +
            "\nposition_m = [" + place + ", 0.5]\n";
  write("hall.toml", hall);
  replace("robot.toml", "[mcl]", R"([[sensor]]
plugin = "landmarks"
kind = "post"
identities = [1, 2, 3]
features = "list"
fov_deg = 360
max_range_m = 20
[mcl])");
  learnTables();
  recordRun();
  using Terms = std::set<std::string>;
  const Terms mount = {"mount x", "mount y", "mount theta"};
  const Terms latency = {"latency"};
  const Terms bias = {"range bias",      "bearing bias", "per m",    "per m and rad",
                      "per m and rad^2", "per rad",      "per rad^2"};
  const auto learnt = [&](const std::string& fixed) {
    const Outcome outcome =
        fixed.empty() ? calibrate({}) : calibrate(std::vector<std::string>{"--fixed", fixed});
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    Terms terms;
    std::istringstream lines(outcome.out);
    for (std::string line; std::getline(lines, line);) {
      const std::size_t begin = std::min(line.find_first_not_of(' '), line.size());
      const std::string name = line.substr(begin, line.find("  ", begin) - begin);
      for (const Terms* some : {&mount, &latency, &bias})
        if (some->contains(name)) terms.insert(name);
    }
    return terms;
  };
  const auto sum = [](Terms some, const Terms& more) {
    some.insert(more.begin(), more.end());
    return some;
  };
  EXPECT_EQ(learnt(""), sum(sum(mount, latency), bias));
  EXPECT_EQ(learnt("bias"), sum(mount, latency));
  EXPECT_EQ(learnt("mount"), sum(latency, bias));
  EXPECT_EQ(learnt("latency"), sum(mount, bias));
  EXPECT_EQ(learnt("bias,mount"), latency);
}

// One scan of 60 beams with 3 cm says where the robot is to some 5 mm, with the scans before it to
// less: no filter is better.
TEST_F(CalibrateNoise, EvalTellsHowGoodEstimatesCouldBe) {
  const Outcome outcome =
      eval("robot.toml", {"--bound", path("hall.toml"), "--json", path("figures.json")});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("Cramer-Rao bound, RMS"), std::string::npos);
  const auto figures = nlohmann::json::parse(read("figures.json"));
  const double rmse = figures.at("bound_rmse_m");
  EXPECT_GT(rmse, 0.0005);
  EXPECT_LT(rmse, 0.006);
  EXPECT_LT(figures.at("bound_median_m").get<double>(), rmse);
  EXPECT_GT(figures.at("ratio_rmse").get<double>(), 1.0);
  EXPECT_NEAR(figures.at("ratio_rmse").get<double>(),
              figures.at("at_corrections").at("position_rmse_m").get<double>() / rmse, 1e-9);
}

}  // namespace
}  // namespace ortung::test
