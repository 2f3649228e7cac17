#include <regex>

#include "Workspace.hpp"

namespace ortung::test {
namespace {

class TrainMotion : public Workspace {
 protected:
  /// run.rec: two minutes of the simulated differential drive, which answers late.
  void record() const {
    write("slow.toml", read("robot.toml") +
                           "[drive]\nacceleration_m_s2 = 0.6\nturn_acceleration_deg_s2 = 120\n");
    const Outcome outcome =
        ortung({"import", "sim", path("hall.toml"), "--out", path("run.rec"), "--option",
                "duration=120", "--option", "seed=3", "--with-robot", path("slow.toml")});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  }
  Outcome train(std::vector<std::string> more = {}) const {
    std::vector<std::string> all = {
        "train-motion",   path("run.rec"), "--robot", path("slow.toml"), "--out",
        path("net.json"), "--iterations",  "150",     "--hidden",        "16"};
    all.insert(all.end(), more.begin(), more.end());
    return ortung(all);
  }
  /// RMSE of the position [m] in the line of @p model.
  static double rmse(const std::string& out, const std::string& model) {
    std::smatch match;
    if (!std::regex_search(out, match, std::regex(model + " +[0-9.]+ +([0-9.]+)"))) return -1.0;
    return std::stod(match[1]);
  }
};

TEST_F(TrainMotion, BeatsConstantVelocityOnWhatItWasNotTrainedWith) {
  record();
  const Outcome outcome = train();
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  const double network = rmse(outcome.out, "network");
  EXPECT_GT(network, 0.0);
  EXPECT_LT(network, 0.5 * rmse(outcome.out, "constant velocity")) << outcome.out;
  const std::string first = read("net.json");
  EXPECT_EQ(train().out, outcome.out);
  EXPECT_EQ(read("net.json"), first);  // the same seed

  // The network as the base of a simulated robot, and for MCL.
  replace("slow.toml", "[drive]\n", "[drive]\nplugin = \"neural\"\nnetwork_file = \"net.json\"\n");
  replace("slow.toml", "turn_acceleration_deg_s2 = 120\n",
          "turn_acceleration_deg_s2 = 120\n[motion]\nplugin = \"neural\"\nnetwork_file = "
          "\"net.json\"\n");
  const Outcome simulated =
      ortung({"import", "sim", path("hall.toml"), "--out", path("neural.rec"), "--option",
              "duration=30", "--option", "seed=5", "--with-robot", path("slow.toml")});
  ASSERT_EQ(simulated.exitCode, 0) << simulated.err;
  learnTables();
  const Outcome evaluated =
      ortung({"eval", "--source", "record:" + path("neural.rec"), "--robot", path("slow.toml"),
              "--tables", path("hall.ortung"), "--start", "truth", "--json", path("e.json")});
  ASSERT_EQ(evaluated.exitCode, 0) << evaluated.err;
  std::smatch match;
  const std::string json = read("e.json");
  ASSERT_TRUE(std::regex_search(json, match, std::regex("\"position_median_m\": ([0-9.e-]+)")))
      << json;
  EXPECT_LT(std::stod(match[1]), 0.15);
}

TEST_F(TrainMotion, RefusesWhatItCantTrainFrom) {
  recordRun();
  write("slow.toml", read("robot.toml"));
  expectRefused(train({"--hold-out", "0.9", "--step", "1"}), 1,
                "ortung train-motion: ", {"steps", "expected at least 100"});
  EXPECT_EQ(train({"--hidden", "0"}).exitCode, 2);
  EXPECT_EQ(train({"--hidden", "a,b"}).exitCode, 2);
  EXPECT_EQ(train({"--commands-from", "stars"}).exitCode, 2);
}

TEST_F(TrainMotion, BrokenNetworksAreRefused) {
  learnTables();
  recordRun();
  write("robot2.toml",
        read("robot.toml") + "[motion]\nplugin = \"neural\"\nnetwork_file = \"net.json\"\n");
  const auto eval = [&] {
    return ortung({"eval", "--source", "record:" + path("run.rec"), "--robot", path("robot2.toml"),
                   "--tables", path("hall.ortung")});
  };
  expectRefused(eval(), 1, "ortung eval: ", {"net.json", "can't be read"});
  write("net.json", "{\"format\": \"ortung motion network 1\", \"step_s\": 0.1");
  expectRefused(eval(), 1, "ortung eval: ", {"net.json", "is no JSON"});
  write("net.json", "{\"format\": \"ortung motion network 1\"}");
  expectRefused(eval(), 1, "ortung eval: ", {"net.json", "step_s"});
}

}  // namespace
}  // namespace ortung::test
