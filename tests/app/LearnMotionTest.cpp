#include <regex>

#include "Workspace.hpp"

namespace ortung::test {
namespace {

class LearnMotion : public Workspace {
 protected:
  Outcome learn(std::vector<std::string> more = {}) const {
    std::vector<std::string> all = {"learn-motion",     path("run.rec"), "--robot",
                                    path("robot.toml"), "--out",         path("motion.toml")};
    all.insert(all.end(), more.begin(), more.end());
    return ortung(all);
  }
  double value(const std::string& key) const {
    const std::string text = read("motion.toml");
    std::smatch match;
    if (!std::regex_search(text, match, std::regex(key + " += ([-0-9.e]+)"))) return -1e9;
    return std::stod(match[1]);
  }
};

// The simulated odometry measures 1.08 of the way and 0.95 of turns; its noise is 0.03 m after 1 m.
TEST_F(LearnMotion, FindsWhatTheSimulatorWasToldToGetWrong) {
  write("robot.toml", read("robot.toml") +
                          "[drive]\nodometry_distance_scale = 1.08\n"
                          "odometry_turn_scale = 0.95\nodometry_distance_sigma_m = 0.03\n");
  ASSERT_EQ(ortung({"import", "sim", path("hall.toml"), "--out", path("run.rec"), "--option",
                    "duration=150", "--option", "seed=3", "--with-robot", path("robot.toml")})
                .exitCode,
            0);
  const Outcome outcome = learn({"--progress"});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  for (const char* bar : {"reading [", "learning ["})
    EXPECT_NE(outcome.err.find(bar), outcome.err.npos) << outcome.err;
  EXPECT_NEAR(value("way_scale"), 1 / 1.08, 0.02);
  EXPECT_NEAR(value("turn_scale"), 1 / 0.95, 0.03);
  EXPECT_NEAR(value("way_per_m"), 0.03 / 1.08, 0.01);
  EXPECT_NEAR(value("delay_s"), 0.0, 0.021);

  learnTables();
  const std::vector<std::string> eval = {"eval",
                                         "--source",
                                         "record:" + path("run.rec"),
                                         "--robot",
                                         path("robot.toml"),
                                         "--tables",
                                         path("hall.ortung"),
                                         "--start",
                                         "truth",
                                         "--motion",
                                         path("motion.toml")};
  const Outcome evaluated = ortung(eval);
  EXPECT_EQ(evaluated.exitCode, 0) << evaluated.err;
}

TEST_F(LearnMotion, RefusesLogsThatTeachNothing) {
  recordRun();
  expectRefused(learn({"--to", "0.1"}), 1,
                "ortung learn-motion: ", {"pieces of motion", "expected at least 30"});
  EXPECT_EQ(learn({"--interval", "-1"}).exitCode, 2);
  write("truthless.toml", "[robot]\n[[sensor]]\nplugin = \"lrf\"\n");
  const Outcome noOdometry = ortung({"learn-motion", path("run.rec"), "--robot",
                                     path("truthless.toml"), "--out", path("m.toml")});
  expectRefused(noOdometry, 1, "ortung learn-motion: ", {"truthless.toml", "has no odometry"});
}

TEST_F(LearnMotion, MotionFilesAreChecked) {
  recordRun();
  learnTables();
  const auto eval = [&](const std::string& motion) {
    return ortung({"eval", "--source", "record:" + path("run.rec"), "--robot", path("robot.toml"),
                   "--tables", path("hall.ortung"), "--motion", motion});
  };
  write("none.toml", "[robot]\n");
  expectRefused(eval(path("none.toml")), 1,
                "ortung eval: ", {"none.toml", "has no table [motion]"});
  write("bad.toml", "[motion]\nturn_per_trun = 1\n");
  expectRefused(eval(path("bad.toml")), 1, "ortung eval: ", {"bad.toml:2", "turn_per_trun"});
  write("range.toml", "[motion]\nway_scale = nan\n");
  expectRefused(eval(path("range.toml")), 1, "ortung eval: ", {"range.toml:2", "way_scale"});
  write("plugin.toml", "[motion]\nplugin = \"hover\"\n");
  expectRefused(eval(path("plugin.toml")), 1, "ortung eval: ", {"hover"});
  expectRefused(eval(path("missing.toml")), 1, "ortung eval: ", {"missing.toml"});
}

}  // namespace
}  // namespace ortung::test
