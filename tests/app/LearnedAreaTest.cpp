// Which part of a divided floor `ortung learn` takes.
#include <regex>

#include "Workspace.hpp"

namespace ortung::test {
namespace {

class LearnedArea : public Workspace {
 protected:
  LearnedArea() {
    // A wall of 0.1 m all across, 2 m from the left: the right part is the larger one.
    write("hall.toml",
          read("hall.toml") +
              "[[rectangle]]\nkind = \"wall\"\ncenter_m = [-0.95, 0]\nsize_m = [0.1, 4]\n");
  }
  Outcome learn(const std::vector<std::string>& more) const {
    std::vector<std::string> command = {
        "learn", "--world",        path("hall.toml"), "--robot", path("robot.toml"),
        "--out", path("t.ortung"), "--cell",          "0.1",     "--heading-step",
        "30",    "--force"};
    command.insert(command.end(), more.begin(), more.end());
    return ortung(command);
  }
  /// How many cells a robot can stand on.
  static int standableIn(const Outcome& outcome) {
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    std::smatch found;
    const bool isThere = std::regex_search(
        outcome.out, found,
        std::regex(", 60 x 40 cells of 0\\.1 m, [0-9]+ open, ([0-9]+) standable,"));
    EXPECT_TRUE(isThere) << outcome.out;
    return isThere ? std::stoi(found[1]) : -1;
  }
  static double leftOutIn(const Outcome& outcome) {
    std::smatch found;
    if (!std::regex_search(outcome.err, found,
                           std::regex("ortung learn: .*hall\\.toml: ([0-9.]+) m\\^2 that walls "
                                      "separate from the robot's area are left out")))
      return 0.0;
    return std::stod(found[1]);
  }
};

TEST_F(LearnedArea, IsTheLargestOneTheNamedOneOrAll) {
  const Outcome larger = learn({});
  const Outcome named = learn({"--area", "1,0"});
  const Outcome smaller = learn({"--area=-2,-1"});
  const Outcome all = learn({"--area", "all"});
  EXPECT_EQ(standableIn(named), standableIn(larger));
  EXPECT_LT(standableIn(smaller), standableIn(larger));
  EXPECT_EQ(standableIn(smaller) + standableIn(larger), standableIn(all));
  // What is left out of one is the other; a cell has 0.01 m^2, of which tenths are printed.
  EXPECT_NEAR(leftOutIn(larger), 0.01 * standableIn(smaller), 0.051);
  EXPECT_NEAR(leftOutIn(smaller), 0.01 * standableIn(larger), 0.051);
  EXPECT_EQ(leftOutIn(all), 0.0) << all.err;
}

TEST_F(LearnedArea, APointWhereNoRobotCanStandIsRefused) {
  write("t.ortung", "PK\x03\x04 open.npy: the old file");
  expectRefused(learn({"--area", "2.4,-1"}), 1, "ortung learn: ", {"2.4"});
  EXPECT_EQ(read("t.ortung"), "PK\x03\x04 open.npy: the old file");
}

TEST_F(LearnedArea, ARobotThatSensesNothingLearnsNothingAndIsToldSo) {
  write("robot.toml",
        "[robot]\nname = \"blind\"\nradius_m = 0.2\n[[sensor]]\nplugin = \"odometry\"\n");
  const Outcome outcome = learn({});
  EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("warning: " + path("robot.toml") +
                             ": has no feature that localizes, so there was nothing to learn"),
            std::string::npos)
      << outcome.err;
  EXPECT_NE(outcome.out.find(": 0 features of blind in hall ("), std::string::npos) << outcome.out;
}

}  // namespace
}  // namespace ortung::test
