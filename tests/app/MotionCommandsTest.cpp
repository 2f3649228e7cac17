// What `learn-motion` and `train-motion` print, and logs that they can't use.
#include <regex>

#include "Workspace.hpp"

namespace ortung::test {
namespace {

class MotionCommands : public Workspace {
 protected:
  MotionCommands() {
    const Outcome outcome =
        ortung({"import", "sim", path("hall.toml"), "--out", path("run.rec"), "--option",
                "duration=60", "--option", "seed=3", "--with-robot", path("robot.toml")});
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
  }
  Outcome learn(const std::vector<std::string>& more) const {
    std::vector<std::string> command = {"learn-motion", "--robot", path("robot.toml"), "--out",
                                        path("motion.toml")};
    command.insert(command.end(), more.begin(), more.end());
    return ortung(command);
  }
  Outcome train(const std::vector<std::string>& more) const {
    std::vector<std::string> command = {
        "train-motion",   path("run.rec"), "--robot", path("robot.toml"), "--out",
        path("net.json"), "--hidden",      "4",       "--iterations",     "5"};
    command.insert(command.end(), more.begin(), more.end());
    return ortung(command);
  }
  /// Leaves out the lines with that text.
  void drop(const std::string& part) const {
    std::string kept;
    ASSERT_EQ(ortung({"import", "record", path("run.rec"), "--out", path("run.txt")}).exitCode, 0);
    std::istringstream text(read("run.txt"));
    for (std::string line; std::getline(text, line);)
      if (line.find(part) == std::string::npos) kept += line + "\n";
    write("run.rec", kept);
  }
};

TEST_F(MotionCommands, WhatIsLearnedIsPrintedAsItIsWritten) {
  const Outcome outcome = learn({path("run.rec")});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  const std::string file = read("motion.toml");
  ASSERT_TRUE(outcome.out.starts_with(file)) << outcome.out;
  EXPECT_TRUE(std::regex_match(outcome.out.substr(file.size()),
                               std::regex("# mean ln p of a piece: -?[0-9]+\\.[0-9]{3}; without "
                                          "the delay -?[0-9]+\\.[0-9]{3}\n")))
      << outcome.out.substr(file.size());
  EXPECT_TRUE(
      file.starts_with("# Learned by `ortung learn-motion` from " + path("run.rec") + ":\n"));
  EXPECT_TRUE(std::regex_search(file, std::regex("\n\\[motion\\]\nplugin = \"odometry\"\n")));
}

TEST_F(MotionCommands, AGivenDelayIsNotLearned) {
  const Outcome outcome = learn({path("run.rec"), "--delay", "0.12"});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  EXPECT_EQ(outcome.out, read("motion.toml")) << "there is nothing to compare it with";
  EXPECT_TRUE(std::regex_search(outcome.out, std::regex("\ndelay_s +=  *0\\.1200  ")))
      << outcome.out;
}

TEST_F(MotionCommands, TwoPartsOfALogHaveTogetherWhatTheWholeHas) {
  const auto metresIn = [](const Outcome& outcome) {
    std::smatch found;
    EXPECT_TRUE(std::regex_search(outcome.out, found,
                                  std::regex("# ([0-9]+) pieces of motion, ([0-9]+) m and")))
        << outcome.out << outcome.err;
    return std::stod(found[2]);
  };
  const double whole = metresIn(learn({path("run.rec"), "--delay", "0"}));
  const double first = metresIn(learn({path("run.rec"), "--delay", "0", "--to", "0.5"}));
  const double second = metresIn(learn({path("run.rec"), "--delay", "0", "--from", "0.5"}));
  EXPECT_GT(first, 0.2 * whole);
  EXPECT_GT(second, 0.2 * whole);
  EXPECT_NEAR(first + second, whole, 2.5);  // each is a whole number, and pieces at the border
  EXPECT_NEAR(metresIn(learn({path("run.rec"), path("run.rec"), "--delay", "0"})), 2 * whole, 1.0);
}

TEST_F(MotionCommands, LogsWithoutTruthOrOdometryAreNamed) {
  drop("groundTruth");
  for (const Outcome& outcome : {learn({path("run.rec")}), train({})})
    expectRefused(outcome, 1, "ortung ",
                  {"record:" + path("run.rec") + ": has no ground truth to learn from",
                   "expected a feature of type groundTruth"});
  drop("odometry/");
  expectRefused(learn({path("run.rec")}), 1, "ortung learn-motion: record:" + path("run.rec"),
                {"has no reading of odometry/odometry/pose, expected odometry to learn from"});
  EXPECT_FALSE(std::filesystem::exists(path("motion.toml")));
}

TEST_F(MotionCommands, TrainingSaysWhatItHasAndHowItGoes) {
  const Outcome outcome = train({"--hold-out", "0.25", "--step", "0.2", "--commands", "3"});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  std::smatch found;
  ASSERT_TRUE(std::regex_search(
      outcome.out, found,
      std::regex("^([0-9]+) examples, ([0-9]+) held out; 0\\.2 s a step, 3 commands, layers 4\n"
                 "iteration  loss      held out\n"
                 "        0  [0-9.]+  [0-9.]+\n")))
      << outcome.out;
  // 60 s are 300 steps, of which a quarter is held out; some at the ends have no neighbours.
  EXPECT_NEAR(std::stod(found[1]), 225.0, 6.0);
  EXPECT_NEAR(std::stod(found[2]), 75.0, 6.0);
  EXPECT_TRUE(std::regex_search(
      outcome.out, std::regex("\npredictions over 1 s, [0-9]+ of the part held out:\n")))
      << outcome.out;
  for (const char* model : {"network", "analytic model", "commands", "constant velocity"})
    EXPECT_NE(outcome.out.find(std::string("\n  ") + model + " "), std::string::npos) << model;
}

TEST_F(MotionCommands, WithNothingHeldOutThereIsNothingToCompare) {
  const Outcome outcome = train({"--hold-out", "0"});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  EXPECT_NE(outcome.out.find(", 0 held out; 0.1 s a step"), std::string::npos) << outcome.out;
  EXPECT_EQ(outcome.out.find("predictions"), std::string::npos) << outcome.out;
}

}  // namespace
}  // namespace ortung::test
