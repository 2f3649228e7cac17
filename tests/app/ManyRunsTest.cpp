// Summaries of many runs against figures by hand.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "ManyRuns.hpp"

namespace ortung::app {
namespace {

using Json = nlohmann::json;

/// Three whole runs of one source: one without a fault, one that was lost for a while, and one that
/// never converged.
std::vector<RunResult> threeRuns() {
  std::vector<RunResult> runs(3);
  for (RunResult& run : runs) run.figures.source = "record:a.rec";
  runs[0].figures.convergedAfter = 2.0;
  runs[0].figures.convergedDistance = 1.0;
  runs[0].errors = {0.25F, 0.5F, 0.75F};
  runs[0].figures.overTime.lostShare = 0.0;
  runs[0].figures.overTime.neesMean = 2.0;
  runs[0].figures.overTime.compared = 10;
  runs[0].figures.atCorrections.compared = 100;
  runs[0].figures.trackingShare = 1.0;
  runs[0].figures.wrongWhileTrackingShare = 0.0;
  runs[0].updateMs = {1.0F, 2.0F};
  runs[1].figures.convergedAfter = 4.0;
  runs[1].figures.convergedDistance = 3.0;
  runs[1].errors = {1.75F};
  runs[1].figures.overTime.lostShare = 0.2;
  runs[1].figures.overTime.neesMean = 6.0;
  runs[1].figures.overTime.compared = 30;
  runs[1].figures.atCorrections.compared = 23;
  runs[1].figures.trackingShare = 0.5;
  runs[1].figures.wrongWhileTrackingShare = 0.1;
  runs[1].updateMs = {3.0F};
  runs[2].figures.overTime.compared = 10;
  runs[2].figures.trackingShare = 0.0;
  runs[2].figures.wrongWhileTrackingShare = 0.0;
  return runs;
}

CaseEvent rightEvent(double after, double way, std::size_t readings) {
  CaseEvent event;
  event.at = 12.5;
  event.place = {1.5, -0.25, 0.0};
  event.isRight = true;
  event.after = after;
  event.travelled = way;
  event.readings = readings;
  return event;
}

std::vector<RunResult> threeKidnaps() {
  std::vector<RunResult> runs(3);
  for (std::size_t i = 0; i < 3; ++i) {
    runs[i].figures.source = "record:b.rec";
    runs[i].kind = RunKind::kKidnap;
    runs[i].number = i + 1;
    runs[i].seed = i + 5;
    runs[i].figures.convergedAfter = 77.0;
    runs[i].figures.convergedDistance = 88.0;
  }
  runs[0].events = {rightEvent(2.0, 1.0, 10)};
  runs[1].events = {rightEvent(3.2, 4.0, 17)};
  runs[2].events = {CaseEvent()};
  return runs;
}

void expectSpread(const Json& spread, double p50, double p95, double p99, double most) {
  EXPECT_NEAR(spread["p50"].get<double>(), p50, 1e-9);
  EXPECT_NEAR(spread["p95"].get<double>(), p95, 1e-9);
  EXPECT_NEAR(spread["p99"].get<double>(), p99, 1e-9);
  EXPECT_NEAR(spread["max"].get<double>(), most, 1e-9);
}

TEST(ManyRuns, RunsOfOneSourceAreCountedAndTheirErrorsPooled) {
  const Json all = Json::parse(toJson(threeRuns()));
  EXPECT_EQ(all["compared_steps"], 123);
  EXPECT_EQ(all["runs"].size(), 3u);
  ASSERT_EQ(all["summary"].size(), 1u);
  const Json& summary = all["summary"][0];
  EXPECT_EQ(summary["source"], "record:a.rec");
  EXPECT_EQ(summary["kind"], "whole");
  EXPECT_EQ(summary["runs"], 3);
  EXPECT_EQ(summary["converged"]["count"], 2);
  EXPECT_EQ(summary["converged"]["of"], 3);
  EXPECT_NEAR(summary["converged"]["share"].get<double>(), 2.0 / 3, 1e-12);
  // Wilson's interval of 2 of 3 with z = 1.96.
  EXPECT_NEAR(summary["converged"]["wilson95"][0].get<double>(), 0.2077, 1e-4);
  EXPECT_NEAR(summary["converged"]["wilson95"][1].get<double>(), 0.9385, 1e-4);
  EXPECT_EQ(summary["never_lost"]["count"], 1);
  EXPECT_EQ(summary["never_lost"]["of"], 3);
  EXPECT_FALSE(summary.contains("right"));
  EXPECT_FALSE(summary.contains("after_readings"));
  // Of {2, 4} s and {1, 3} m, of {0.25, 0.5, 0.75, 1.75} m, of {1, 2, 3} ms.
  expectSpread(summary["after_s"], 3.0, 3.9, 3.98, 4.0);
  expectSpread(summary["after_m"], 2.0, 2.9, 2.98, 3.0);
  expectSpread(summary["position_m"], 0.625, 1.6, 1.72, 1.75);
  expectSpread(summary["update_ms"], 2.0, 2.9, 2.98, 3.0);
}

TEST(ManyRuns, SharesAreMeansOverTheTimeThatTheyAreOf) {
  const Json summary = Json::parse(toJson(threeRuns()))["summary"][0];
  // After convergence: 3 times and 1 time.
  EXPECT_NEAR(summary["lost_share"].get<double>(), (3 * 0.0 + 1 * 0.2) / 4, 1e-12);
  EXPECT_NEAR(summary["nees_mean"].get<double>(), (3 * 2.0 + 1 * 6.0) / 4, 1e-12);
  // All times that were compared: 10, 30 and 10.
  EXPECT_NEAR(summary["tracking_share"].get<double>(), (10 * 1.0 + 30 * 0.5 + 0) / 50, 1e-12);
  EXPECT_NEAR(summary["wrong_while_tracking_share"].get<double>(), 30 * 0.1 / 50, 1e-12);
}

// Only time with the status "tracking" counts, and only runs that have some.
TEST(ManyRuns, ProtectionLevelsAreOfTimeThatIsTracked) {
  std::vector<RunResult> runs = threeRuns();
  runs[0].figures.beyondProtectionShare = 0.0;  // of 10 times
  runs[1].figures.beyondProtectionShare = 0.2;  // of half of 30 times
  runs[2].figures.beyondProtectionShare = std::numeric_limits<double>::quiet_NaN();
  const Json summary = Json::parse(toJson(runs))["summary"][0];
  EXPECT_NEAR(summary["beyond_protection_share"].get<double>(), 15 * 0.2 / 25, 1e-12);
  EXPECT_EQ(summary["never_beyond_protection"]["count"], 1);
  EXPECT_EQ(summary["never_beyond_protection"]["of"], 2);
}

TEST(ManyRuns, WhatNoRunHasIsNull) {
  std::vector<RunResult> runs = {threeRuns()[2]};
  runs[0].figures.trackingShare = std::numeric_limits<double>::quiet_NaN();
  const Json summary = Json::parse(toJson(runs))["summary"][0];
  EXPECT_EQ(summary["converged"]["count"], 0);
  EXPECT_EQ(summary["converged"]["share"], 0.0);
  for (const char* key : {"lost_share", "tracking_share", "nees_mean"})
    EXPECT_TRUE(summary[key].is_null()) << key;
  for (const char* key : {"after_s", "after_m", "position_m", "update_ms"})
    for (const char* quantile : {"p50", "p95", "p99", "max"})
      EXPECT_TRUE(summary[key][quantile].is_null()) << key;
}

TEST(ManyRuns, CasesAreJudgedByTheirEvents) {
  const Json summary = Json::parse(toJson(threeKidnaps()))["summary"][0];
  EXPECT_EQ(summary["kind"], "kidnap");
  EXPECT_FALSE(summary.contains("converged"));
  EXPECT_EQ(summary["right"]["count"], 2);
  EXPECT_EQ(summary["right"]["of"], 3);
  expectSpread(summary["after_s"], 2.6, 3.14, 3.188, 3.2);
  expectSpread(summary["after_m"], 2.5, 3.85, 3.97, 4.0);
  expectSpread(summary["after_readings"], 13.5, 16.65, 16.93, 17.0);
}

TEST(ManyRuns, EachSourceAndKindHasASummaryInTheOrderOfTheirFirstRuns) {
  std::vector<RunResult> runs = threeKidnaps();
  for (const RunResult& run : threeRuns()) runs.push_back(run);
  runs.push_back(threeKidnaps()[0]);
  runs.back().kind = RunKind::kWakeUp;
  runs.push_back(threeKidnaps()[1]);
  const Json all = Json::parse(toJson(runs));
  ASSERT_EQ(all["summary"].size(), 3u);
  EXPECT_EQ(all["summary"][0]["kind"], "kidnap");
  EXPECT_EQ(all["summary"][0]["runs"], 4);
  EXPECT_EQ(all["summary"][1]["source"], "record:a.rec");
  EXPECT_EQ(all["summary"][2]["kind"], "wake-up");
  EXPECT_EQ(all["summary"][2]["runs"], 1);
  EXPECT_EQ(all["runs"].size(), 8u);
}

TEST(ManyRuns, TheTextHasTheSameFiguresWithTheirUnits) {
  std::vector<RunResult> runs = threeRuns();
  for (RunResult& run : runs) run.faults = {"odometry=none"};
  EXPECT_EQ(toText(runs),
            "record:a.rec: 3 runs\n"
            "  with odometry=none\n"
            "  Converged                         2 of 3, 66.7 % (95 %: 20.8 to 93.9)\n"
            "  Converged and never lost          1 of 3, 33.3 % (95 %: 6.1 to 79.2)\n"
            "  After (p50, p95, p99, most)       3.0, 3.9, 4.0, 4.0 s\n"
            "                                    2.00, 2.90, 2.98, 3.00 m\n"
            "  Position error                    0.625, 1.600, 1.720, 1.750 m\n"
            "  Share of time lost                5.00 %\n"
            "  Time with status tracking         50.00 %\n"
            "  ... with an error above 1 m       6.000 %\n"
            "  ... with one beyond the bound     -\n"
            "  Runs never beyond it              - (none)\n"
            "  Consistency (NEES, 3 is right)    3.00\n"
            "  Time per update                   2.000, 2.900, 2.980, 3.000 ms\n");
}

TEST(ManyRuns, TheTextListsAllCases) {
  const std::string text = toText(threeKidnaps());
  EXPECT_TRUE(
      text.starts_with("record:b.rec: 3 kidnap runs\n"
                       "  Right                             2 of 3, 66.7 % (95 %: 20.8 to 93.9)\n"
                       "  After (p50, p95, p99, most)       2.6, 3.1, 3.2, 3.2 s\n"))
      << text;
  EXPECT_NE(text.find("\n                                    14, 17, 17, 17 readings\n"), text.npos)
      << text;
  EXPECT_TRUE(text.ends_with(
      "    kidnap 1 (seed 5), at 12.5 s in (1.50, -0.25) m: right after 2.0 s, 1.0 m, 10 readings\n"
      "    kidnap 2 (seed 6), at 12.5 s in (1.50, -0.25) m: right after 3.2 s, 4.0 m, 17 readings\n"
      "    kidnap 3 (seed 7), at 0.0 s in (0.00, 0.00) m: never right\n"))
      << text;
}

TEST(ManyRuns, TheTextListsTheCasesOfEachSourceAndKindUnderItsOwnLine) {
  std::vector<RunResult> runs = {threeKidnaps()[0], threeKidnaps()[1], threeKidnaps()[2]};
  runs[1].figures.source = "record:c.rec";
  runs[2].kind = RunKind::kWakeUp;
  std::string outline;  // what has a case's line below itself
  std::istringstream text(toText(runs));
  for (std::string line; std::getline(text, line);)
    if (!line.starts_with("  ") || line.starts_with("    kidnap") || line.starts_with("    wake"))
      outline += line.substr(0, line.find(", at")) + "\n";
  EXPECT_EQ(outline,
            "record:b.rec: 1 kidnap runs\n"
            "    kidnap 1 (seed 5)\n"
            "record:c.rec: 1 kidnap runs\n"
            "    kidnap 2 (seed 6)\n"
            "record:b.rec: 1 wake-up runs\n"
            "    wake-up 3 (seed 7)\n");
}

TEST(ManyRuns, TheTextSaysDashForWhatIsNotKnown) {
  std::vector<RunResult> runs = {threeKidnaps()[0]};
  runs[0].events.clear();
  const std::string text = toText(runs);
  for (const char* line :
       {"  Right                             - (none)\n", "  After (p50, p95, p99, most)       -\n",
        "  Position error                    -\n", "  Share of time lost                -\n"})
    EXPECT_NE(text.find(line), text.npos) << text;
}

}  // namespace
}  // namespace ortung::app
