#include <gtest/gtest.h>

#include <cmath>

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

// Most of the colours of a reading that is probable at one place only would be one colour.
TEST_F(Show, ColoursGoByLogarithmsWhereLinearOnesShowNextToNothing) {
  const auto legendOf = [&](const std::vector<std::string>& scale) {
    std::vector<std::string> more = {"--feature", "*/LRF/*", "--record", path("run.rec"),
                                     "--at",      "5",       "--force"};
    more.insert(more.end(), scale.begin(), scale.end());
    const Outcome outcome = show(more);
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    std::vector<double> legend;
    for (std::size_t at = outcome.out.find(" %: "); at != outcome.out.npos;
         at = outcome.out.find(" %: ", at + 1))
      legend.push_back(std::stod(outcome.out.substr(at + 4)));
    EXPECT_EQ(legend.size(), 5u) << outcome.out;
    legend.resize(5);
    return legend;
  };
  const auto expectEven = [](const std::vector<double>& values) {
    for (std::size_t i = 2; i < values.size(); ++i)  // of four digits
      EXPECT_NEAR(values[i] - values[i - 1], values[1] - values[0],
                  2e-3 * std::abs(values[1] - values[0]))
          << i;
  };
  recordRun();
  std::vector<double> logarithms;
  for (const double value : legendOf({"--scale", "log"})) logarithms.push_back(std::log(value));
  expectEven(logarithms);
  expectEven(legendOf({"--scale", "linear"}));
  EXPECT_EQ(legendOf({"--log"}), legendOf({"--scale", "log"}));
  EXPECT_EQ(legendOf({}), legendOf({"--scale", "log"}));
  // A single beam fits some heading nearly everywhere.
  replace("robot.toml", "beams = 60", "beams = 1");
  learnTables();
  recordRun();
  EXPECT_EQ(legendOf({}), legendOf({"--scale", "linear"}));
  EXPECT_NE(legendOf({}), legendOf({"--scale", "log"}));
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
