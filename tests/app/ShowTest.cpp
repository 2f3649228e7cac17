#include <gtest/gtest.h>

#include "Workspace.hpp"

namespace ortung::test {
namespace {

class Show : public Workspace {
 protected:
  Show() { learnTables(); }
  Outcome show(const std::vector<std::string>& more) const {
    std::vector<std::string> arguments = {
        "show", path("hall.ortung"), "--robot", path("robot.toml"), "--out", path("heat.png")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return ortung(arguments);
  }
  bool isPng() const { return read("heat.png").starts_with("\x89PNG"); }
};

TEST_F(Show, DrawsAnExpectationAndPrintsItsLegend) {
  const Outcome outcome = show({"--feature", "LMS200/LRF/*", "--beam", "30", "--heading", "90"});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  EXPECT_TRUE(isPng());
  EXPECT_NE(outcome.out.find("expectation of LMS200/LRF/180DegreeScan [30]"), std::string::npos)
      << outcome.out;
  EXPECT_NE(outcome.out.find(" m\n"), std::string::npos) << outcome.out;
}

TEST_F(Show, DrawsWhereAReadingIsProbableWithTheTruePose) {
  recordRun();
  const Outcome outcome = show({"--feature", "*/LRF/*", "--record", path("run.rec"), "--at", "5"});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  EXPECT_TRUE(isPng());
  EXPECT_NE(outcome.out.find("true pose: "), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("most probable pose: "), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("; each cell: the best of "), std::string::npos) << outcome.out;
}

TEST_F(Show, TakesTheProductOfSeveralFeatures) {
  write("robot.toml", read("robot.toml") +
                          "[[sensor]]\nplugin = \"lrf\"\nmodel = \"rear\"\nbeams = 30\n" +
                          "pose = { x_m = 0, y_m = 0, theta_deg = 180 }\n");
  learnTables();
  recordRun();
  const Outcome outcome =
      show({"--feature", "LMS200/*/*", "--feature", "rear/*/*", "--record", path("run.rec")});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("2 features"), std::string::npos) << outcome.out;
  expectRefused(show({"--feature", "*/LRF/*"}), 2, "ortung show: --feature matches 2 features",
                {"rear/LRF"});
}

TEST_F(Show, RefusesWhatItCannotDraw) {
  expectRefused(show({"--feature", "*/sonar/*"}), 1, "ortung show: " + path("robot.toml"),
                {"*/sonar/*", "LMS200/LRF/180DegreeScan"});
  expectRefused(show({"--feature", "LMS200/LRF"}), 2, "ortung show: --feature", {});
  expectRefused(show({"--feature", "*/LRF/*", "--beam", "60"}), 1,
                "ortung show: ", {"--beam is 60", "60 values"});
  recordRun();
  expectRefused(show({"--feature", "*/LRF/*", "--record", path("run.rec"), "--at", "100"}), 1,
                "ortung show: record:", {"ends after"});
  EXPECT_FALSE(std::filesystem::exists(path("heat.png")));
  expectRefused(show({"--feature", "*/LRF/*", "--scale", "cubic"}), 2, "ortung",
                {"--scale", "log"});
}

}  // namespace
}  // namespace ortung::test
