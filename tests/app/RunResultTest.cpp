#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "RunResult.hpp"
#include "SyntheticRun.hpp"

namespace ortung::app {
namespace {

TEST(RunResult, JsonHasTheKeysThatMachinesReadInTheirUnits) {
  const auto json = nlohmann::json::parse(toJson(syntheticRun()));
  for (const char* key :
       {"source", "steps", "duration_s", "particles_mean", "position_rmse_m", "position_median_m",
        "position_p95_m", "heading_rmse_deg", "converged_after_s", "lost_share", "update_ms_p50",
        "update_ms_p99", "realtime_factor", "nees_mean", "seed", "robot", "tables", "particles",
        "compared_steps"}) {
    EXPECT_TRUE(json.contains(key)) << key;
  }
  EXPECT_EQ(json["source"], "record:circle.rec");
  EXPECT_NEAR(json["heading_rmse_deg"].get<double>(), 1.0, 1e-9);
  EXPECT_EQ(json["converged_after_s"], 5.0);
  EXPECT_EQ(json["seed"], 7);
}

TEST(RunResult, JsonSaysNullForWhatIsNoNumber) {
  RunResult run = syntheticRun();
  run.figures.convergedAfter.reset();
  run.figures.overTime.positionRmse = std::numeric_limits<double>::quiet_NaN();
  run.figures.realtimeFactor = std::numeric_limits<double>::infinity();
  const auto json = nlohmann::json::parse(toJson(run));
  EXPECT_TRUE(json["converged_after_s"].is_null());
  EXPECT_TRUE(json["position_rmse_m"].is_null());
  EXPECT_TRUE(json["realtime_factor"].is_null());
}

TEST(RunResult, JsonIsValidWhateverAFileIsCalled) {
  RunResult run = syntheticRun();
  run.robot = "a\"b\\\xFF\n.toml";
  EXPECT_TRUE(nlohmann::json::accept(toJson(run)));
}

TEST(RunResult, SummaryNamesTheSourceAndSaysDashForWhatIsNotKnown) {
  RunResult run = syntheticRun();
  run.figures.overTime.compared = 0;
  run.figures.convergedAfter.reset();
  run.figures.overTime.positionRmse = std::numeric_limits<double>::quiet_NaN();
  const std::string text = toText(run);
  EXPECT_NE(text.find("record:circle.rec"), std::string::npos);
  EXPECT_EQ(text.find("never"), std::string::npos);
  EXPECT_EQ(text.find("nan"), std::string::npos);
}

}  // namespace
}  // namespace ortung::app
