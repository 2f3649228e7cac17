// The figures of one run as lines and as JSON, each with a number of its own.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <numbers>

#include "RunResult.hpp"

namespace ortung::app {
namespace {

constexpr double kPi = std::numbers::pi;

/// A run in which no two figures are equal.
RunResult figuredRun() {
  RunResult run;
  EvaluationResult& figures = run.figures;
  figures.source = "record:run.rec";
  figures.steps = 321;
  figures.duration = 61.25;
  figures.particlesMean = 1234.4;
  figures.convergedAfter = 5.0;
  figures.period = 0.2;
  figures.overTime = {.compared = 299,
                      .positionRmse = 0.1234,
                      .positionMedian = 0.0987,
                      .positionP95 = 0.3456,
                      .positionP99 = 0.4567,
                      .positionMax = 0.9876,
                      .headingRmse = kPi / 72,
                      .lostShare = 0.0625,
                      .neesMean = 2.876,
                      .neesAboveShare = 0.01};
  figures.atCorrections.compared = 300;
  figures.atCorrections.positionRmse = 0.12;
  figures.atCorrections.positionMedian = 0.09;
  figures.trackingShare = 0.875;
  figures.wrongWhileTrackingShare = 0.0125;
  figures.beyondProtectionShare = 0.0025;
  figures.protectionMedian = 0.0321;
  figures.updateMsP50 = 0.2504;
  figures.updateMsP99 = 0.7506;
  figures.updateMsMax = 8.5;
  figures.realtimeFactor = 299.6;
  run.first = fromSeconds(100.0);
  return run;
}

std::string valueOf(const RunResult& run, const std::string& name) {
  for (const Figure& figure : figuresOf(run))
    if (figure.name == name) return figure.value;
  return "(there is no " + name + ")";
}

TEST(RunFigures, AreRoundedAndHaveTheirUnits) {
  const RunResult run = figuredRun();
  const std::vector<std::pair<std::string, std::string>> expected = {
      {"Duration", "61.2 s"},
      {"Updates", "321"},
      {"Updates with known truth", "300"},
      {"Times compared, every 0.2 s", "299"},
      {"Converged after", "5.0 s"},
      {"Position error, RMS", "0.123 m"},
      {"Position error, median", "0.099 m"},
      {"Position error, 95 %", "0.346 m"},
      {"Position error, 99 %", "0.457 m"},
      {"Position error, max", "0.988 m"},
      {"Heading error, RMS", "2.50 deg"},
      {"Share of time lost", "6.2 %"},
      {"Time with status tracking", "87.5 %"},
      {"... with an error above 1 m", "1.25 %"},
      {"... with one beyond the bound", "0.25 %"},
      {"... bound of the position error, median", "0.032 m"},
      {"Consistency (NEES, 3 is right)", "2.88"},
      {"Position error at updates, RMS", "0.120 m"},
      {"Samples, mean", "1234"},
      {"Time per update, median", "0.250 ms"},
      {"Time per update, 99 %", "0.751 ms"},
      {"Time per update, max", "8.500 ms"},
      {"Speed relative to real time", "300 x"}};
  const std::vector<Figure> found = figuresOf(run);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].name, expected[i].first);
    EXPECT_EQ(found[i].value, expected[i].second) << found[i].name;
  }
}

TEST(RunFigures, ConvergenceIsNeverOrNotKnown) {
  RunResult run = figuredRun();
  run.figures.convergedAfter.reset();
  EXPECT_EQ(valueOf(run, "Converged after"), "never");
  run.figures.overTime.compared = 0;
  EXPECT_EQ(valueOf(run, "Converged after"), "-");
}

TEST(RunFigures, TheTextNamesSourceFaultsAndWhatErrorsAreOf) {
  RunResult run = figuredRun();
  run.figures.source = "record:a\nb.rec";
  run.faults = {"odometry=none", "readings=crowd@8-12"};
  const std::string text = toText(run);
  EXPECT_TRUE(
      text.starts_with("record:a\\x0ab.rec\n  with odometry=none\n"
                       "  with readings=crowd@8-12\n"
                       "  Duration                              61.2 s\n"))
      << text;
  EXPECT_TRUE(
      text.ends_with("\nErrors are taken every 0.2 s after convergence; odometry predicts "
                     "poses between updates\n"))
      << text;
}

// The bound's ratios are of the errors at updates, which it bounds.
TEST(RunFigures, TheBoundStandsBesideTheErrorsAtUpdates) {
  RunResult run = figuredRun();
  auto json = nlohmann::json::parse(toJson(run));
  for (const char* key :
       {"bound_median_m", "bound_rmse_m", "bound_heading_rmse_deg", "ratio_median", "ratio_rmse"})
    EXPECT_TRUE(json[key].is_null()) << key;
  run.bound = BoundFigures{.positionMedian = 0.03, .positionRmse = 0.08, .headingRmse = kPi / 360};
  EXPECT_EQ(valueOf(run, "Cramer-Rao bound, median"), "0.0300 m");
  EXPECT_EQ(valueOf(run, "Cramer-Rao bound, RMS"), "0.0800 m");
  EXPECT_EQ(valueOf(run, "Median at updates / bound"), "3.0 x");
  EXPECT_EQ(valueOf(run, "RMS at updates / bound"), "1.5 x");
  json = nlohmann::json::parse(toJson(run));
  EXPECT_DOUBLE_EQ(json["bound_median_m"].get<double>(), 0.03);
  EXPECT_DOUBLE_EQ(json["bound_rmse_m"].get<double>(), 0.08);
  EXPECT_NEAR(json["bound_heading_rmse_deg"].get<double>(), 0.5, 1e-12);
  EXPECT_NEAR(json["ratio_median"].get<double>(), 3.0, 1e-12);
  EXPECT_NEAR(json["ratio_rmse"].get<double>(), 1.5, 1e-12);
}

// It converges 5 s after the first reading, at 105 s.
TEST(RunFigures, TheGridIsComparedAfterConvergenceByMedians) {
  RunResult run = figuredRun();
  run.besideGrid = {{fromSeconds(104.9), 90.0, 9.0},
                    {fromSeconds(105.0), 0.5, 0.03},
                    {fromSeconds(106.0), 0.7, 0.01},
                    {fromSeconds(107.0), 0.6, 0.02}};
  EXPECT_EQ(valueOf(run, "Divergence from the grid, median"), "0.600 nats");
  EXPECT_EQ(valueOf(run, "Distance from the grid, median"), "0.020 m");
  const auto json = nlohmann::json::parse(toJson(run));
  EXPECT_DOUBLE_EQ(json["grid_divergence_median"].get<double>(), 0.6);
  EXPECT_DOUBLE_EQ(json["grid_distance_median_m"].get<double>(), 0.02);
  run.figures.convergedAfter.reset();
  EXPECT_EQ(valueOf(run, "Divergence from the grid, median"), "-");
}

TEST(RunFigures, GapsAreFromThePointBeforeToThePointAfter) {
  RunResult run = figuredRun();
  for (const double seconds : {101.0, 101.5, 104.0, 104.5, 109.25}) {
    EvaluationPoint& point = run.figures.points.emplace_back();
    point.stamp = fromSeconds(seconds);
    point.followsGap = seconds == 104.0 || seconds == 109.25;
  }
  const auto json = nlohmann::json::parse(toJson(run));
  EXPECT_EQ(json["gaps"], nlohmann::json::parse("[[1.5, 4.0], [4.5, 9.25]]"));
}

TEST(RunFigures, ACaseHasItsEventsAndNothingForThoseThatDidNotComeRight) {
  RunResult run = figuredRun();
  EXPECT_FALSE(nlohmann::json::parse(toJson(run)).contains("case"));
  run.kind = RunKind::kWakeUp;
  run.number = 3;
  run.events = {
      {.at = 7.5,
       .place = {1.0, -2.0, kPi / 2},
       .isRight = true,
       .after = 2.5,
       .travelled = 0.75,
       .readings = 12},
      {.at = 9.0, .place = {}, .isRight = false, .after = 4.0, .travelled = 5.0, .readings = 6}};
  const auto json = nlohmann::json::parse(toJson(run));
  EXPECT_EQ(json["case"]["kind"], "wake-up");
  EXPECT_EQ(json["case"]["number"], 3);
  EXPECT_NEAR(json["case"]["events"][0]["heading_deg"].get<double>(), 90.0, 1e-12);
  auto first = json["case"]["events"][0];
  first.erase("heading_deg");
  EXPECT_EQ(first, nlohmann::json::parse(R"({"at_s": 7.5, "x_m": 1.0, "y_m": -2.0, "right": true,
      "after_s": 2.5, "after_m": 0.75, "after_readings": 12})"));
  const auto& second = json["case"]["events"][1];
  EXPECT_EQ(second["right"], false);
  for (const char* key : {"after_s", "after_m", "after_readings"})
    EXPECT_TRUE(second[key].is_null()) << key;
}

TEST(RunFigures, KindsHaveTheirNames) {
  EXPECT_STREQ(nameOf(RunKind::kWhole), "whole");
  EXPECT_STREQ(nameOf(RunKind::kKidnap), "kidnap");
  EXPECT_STREQ(nameOf(RunKind::kWakeUp), "wake-up");
  EXPECT_STREQ(nameOf(RunKind::kTeleports), "teleports");
}

// An estimate is right below 0.5 m: that is what the filter's quality claims.
TEST(RunFigures, QualityIsComparedWithErrorsBelowHalfAMetre) {
  std::vector<EvaluationPoint> points(4);
  points[0].quality = 0.95;
  points[0].positionError = 0.49;
  points[1].quality = 0.95;
  points[1].positionError = 0.5;
  points[2].quality = 0.15;
  points[2].positionError = 0.1;
  points[3].quality = 0.15;
  points[3].positionError = 3.0;
  RunResult run = figuredRun();
  run.calibration = qualityCalibration(points);
  const auto quality = nlohmann::json::parse(toJson(run))["quality"];
  ASSERT_EQ(quality["bins"].size(), 10u);
  EXPECT_EQ(quality["bins"][9]["moments"], 2);
  EXPECT_NEAR(quality["bins"][9]["claimed"].get<double>(), 0.95, 1e-6);
  EXPECT_EQ(quality["bins"][9]["right_share"], 0.5);
  EXPECT_EQ(quality["bins"][1]["right_share"], 0.5);
  EXPECT_EQ(quality["bins"][5]["moments"], 0);
  EXPECT_TRUE(quality["bins"][5]["claimed"].is_null());
  // |0.95 - 0.5| and |0.15 - 0.5|, each of half the moments; right ones are as often higher.
  EXPECT_NEAR(quality["calibration_error"].get<double>(), 0.4, 1e-6);
  EXPECT_NEAR(quality["area_under_curve"].get<double>(), 0.5, 1e-12);
}

}  // namespace
}  // namespace ortung::app
