// The grid filter as users get it.
#include <nlohmann/json.hpp>

#include "Workspace.hpp"
#include "ortung/run/Localization.hpp"

namespace ortung::test {
namespace {

class Grid : public Workspace {
 protected:
  Grid() {
    // One scanner with three beams leaves a belief that cells of 10 cm can hold.
    replace("robot.toml", "beams = 60\nfov_deg = 180\nmax_range_m = 8\n",
            "beams = 3\nfov_deg = 180\nmax_range_m = 8\nsigma_m = 0.15\n");
    learnTables();
    recordRun();
  }
  Outcome eval(const std::vector<std::string>& more) const {
    std::vector<std::string> arguments = {"eval",
                                          "--source",
                                          "record:" + path("run.rec"),
                                          "--robot",
                                          path("robot.toml"),
                                          "--tables",
                                          path("hall.ortung"),
                                          "--start",
                                          "truth",
                                          "--json",
                                          path("figures.json"),
                                          "--force"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return ortung(arguments);
  }
  nlohmann::json figures() const { return nlohmann::json::parse(read("figures.json")); }
};

TEST_F(Grid, FindsTheRobotAsMclDoes) {
  ASSERT_EQ(eval({}).exitCode, 0);
  const double ofMcl = figures().at("position_rmse_m");
  EXPECT_TRUE(figures().at("grid_divergence_median").is_null());
  const Outcome outcome = eval({"--filter", "grid"});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  // A machine that is slow is told how far the run is.
  const std::regex progress("[^\n]*: localizing: [^\n]*\n");
  EXPECT_EQ(std::regex_replace(outcome.err, progress, ""), "");
  EXPECT_LT(figures().at("position_rmse_m").get<double>(), 1.5 * ofMcl + 0.05);
  EXPECT_EQ(figures().at("lost_share"), 0.0);
  const std::string poses = path("poses.txt");
  EXPECT_EQ(ortung({"localize", "--source", "record:" + path("run.rec"), "--robot",
                    path("robot.toml"), "--tables", path("hall.ortung"), "--filter", "grid",
                    "--grid", "0.2,10", "--out", poses})
                .exitCode,
            0);
}

TEST_F(Grid, TellsHowFarSamplesAreFromIt) {
  const Outcome outcome = eval({"--against-grid", "--grid", "0.05,3"});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("Divergence from the grid, median"), std::string::npos);
  const double divergence = figures().at("grid_divergence_median");
  EXPECT_GT(divergence, 0.0);
  EXPECT_LT(divergence, 0.5);
  EXPECT_LT(figures().at("grid_distance_median_m").get<double>(), 0.1);
}

TEST_F(Grid, WhatIsWrongWithItsOptionsIsSaid) {
  expectRefused(eval({"--grid", "0.1"}), 2, "ortung", {"--grid", "cell_m"});
  expectRefused(eval({"--grid", "0,5"}), 2, "ortung", {"--grid", "[0.01, 10]"});
  expectRefused(eval({"--filter", "kalman"}), 2, "ortung", {"--filter", "kalman"});
  expectRefused(eval({"--filter", "grid", "--against-grid"}), 2, "ortung", {"--against-grid"});
  expectRefused(eval({"--filter", "grid", "--grid", "0.01,0.1"}), 1, "ortung",
                {"a grid of", "GB", "larger cells"});
}

TEST_F(Grid, HasNoBeliefThatCanBeSet) {
  LocalizationConfig config{.robot = path("robot.toml"), .tables = path("hall.ortung")};
  config.filter = LocalizationFilter::kGrid;
  Localization localization(config);
  EXPECT_THROW(localization.relocalize(), std::logic_error);
  EXPECT_THROW(localization.setPose({}, {}), std::logic_error);
  EXPECT_THROW(localization.saveBelief(path("belief")), std::logic_error);
  config.publish = true;
  EXPECT_THROW(Localization{config}, std::logic_error);
}

}  // namespace
}  // namespace ortung::test
