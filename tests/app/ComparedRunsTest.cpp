// Which differences of two runs are listed, and with which words, against rules by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "Comparison.hpp"

namespace ortung::app {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

FiledRun runWith(std::map<std::string, double> figures) {
  FiledRun run;
  run.source = "record:run.rec";
  run.robot = "robot.toml";
  run.seed = 3;
  run.figures = {{"converged_after_s", 2.0}, {"lost_share", 0.0}, {"position_median_m", 0.1}};
  for (const auto& [key, value] : figures) run.figures[key] = value;
  return run;
}

/// Why the second run is listed, after "+" if it is better and "-" if it is worse; "": it is not.
std::string changeOf(const FiledRun& before, const FiledRun& after) {
  const Comparison c = compare({before}, {after});
  EXPECT_LE(c.changed.size(), 1u);
  return c.changed.empty() ? "" : (c.changed[0].isBetter ? "+" : "-") + c.changed[0].why;
}

std::string changeOf(const std::string& figure, double before, double after) {
  return changeOf(runWith({{figure, before}}), runWith({{figure, after}}));
}

TEST(ComparedRuns, AreListedIfOnlyOneConverges) {
  EXPECT_EQ(changeOf("converged_after_s", kNan, 3.0), "+converges now");
  EXPECT_EQ(changeOf("converged_after_s", 3.0, kNan), "-no longer converges");
  EXPECT_EQ(changeOf("converged_after_s", 3.0, 30.0), "");
  EXPECT_EQ(changeOf("converged_after_s", kNan, kNan), "");
}

TEST(ComparedRuns, AreListedIfTheyAreLostForAPercentMoreOrLess) {
  EXPECT_EQ(changeOf("lost_share", 0.1, 0.109), "");
  EXPECT_EQ(changeOf("lost_share", 0.1, 0.125), "-lost for 12.5 % instead of 10.0 % of the time");
  EXPECT_EQ(changeOf("lost_share", 0.125, 0.1), "+lost for 10.0 % instead of 12.5 % of the time");
}

// 5 cm, or a fifth of the smaller one.
TEST(ComparedRuns, AreListedIfNearlyAllErrorsAreMuchSmallerOrLarger) {
  EXPECT_EQ(changeOf("position_p95_m", 0.1, 0.149), "");
  EXPECT_EQ(changeOf("position_p95_m", 0.1, 0.151),
            "-95 % of the errors below 0.151 m instead of 0.100 m");
  EXPECT_EQ(changeOf("position_p95_m", 0.151, 0.1),
            "+95 % of the errors below 0.100 m instead of 0.151 m");
  EXPECT_EQ(changeOf("position_p95_m", 1.0, 1.19), "");
  EXPECT_EQ(changeOf("position_p95_m", 1.19, 1.0), "");
  EXPECT_EQ(changeOf("position_p95_m", 1.0, 1.21),
            "-95 % of the errors below 1.210 m instead of 1.000 m");
  EXPECT_EQ(changeOf("position_p95_m", 1.21, 1.0),
            "+95 % of the errors below 1.000 m instead of 1.210 m");
  EXPECT_EQ(changeOf("position_p95_m", kNan, 1.0), "");
}

TEST(ComparedRuns, TheMostImportantDifferenceIsTheOneThatIsSaid) {
  const FiledRun good = runWith({{"position_p95_m", 0.1}});
  EXPECT_EQ(changeOf(good, runWith({{"converged_after_s", kNan}, {"lost_share", 1.0}})),
            "-no longer converges");
  EXPECT_EQ(changeOf(good, runWith({{"lost_share", 0.5}, {"position_p95_m", 0.01}})),
            "-lost for 50.0 % instead of 0.0 % of the time");
}

TEST(ComparedRuns, OfCasesOnlyTheirEventsCount) {
  FiledRun before = runWith({{"lost_share", 0.0}});
  before.kind = "kidnap";
  FiledRun after = runWith({{"lost_share", 0.9}});
  after.kind = "kidnap";
  before.events = {{true, 1.0, 5.0}, {true, 1.0, 5.0}};
  after.events = before.events;
  EXPECT_EQ(changeOf(before, after), "");
  after.events[1].isRight = false;
  EXPECT_EQ(changeOf(before, after), "-no longer localizes");
  EXPECT_EQ(changeOf(after, before), "+localizes now");
}

TEST(ComparedRuns, WorseOnesComeFirst) {
  std::vector<FiledRun> before, after;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    before.push_back(runWith({{"lost_share", 0.5}}));
    after.push_back(runWith({{"lost_share", seed == 2 ? 0.9 : 0.1}}));
    before.back().seed = after.back().seed = seed;
  }
  const Comparison c = compare(before, after);
  ASSERT_EQ(c.changed.size(), 3u);
  EXPECT_EQ(c.changed[0].name, before[1].name());
  EXPECT_EQ(c.changed[1].name, before[0].name());
  EXPECT_EQ(c.changed[2].name, before[2].name());
}

const ComparedFigure* figureIn(const Comparison& c, const std::string& name) {
  for (const ComparedFigure& figure : c.figures)
    if (figure.name == name) return &figure;
  return nullptr;
}

// A NEES of 1.5 is as far off 3 as one of 6, ln 2.
TEST(ComparedRuns, ConsistencyIsHowFarItIsOffThreeInLogarithms) {
  const auto compared = [](double before, double after) {
    const Comparison c =
        compare({runWith({{"nees_mean", before}})}, {runWith({{"nees_mean", after}})});
    const ComparedFigure* nees = figureIn(c, "nees_mean, |ln| off 3");
    EXPECT_NE(nees, nullptr);
    return nees == nullptr ? ComparedFigure() : *nees;
  };
  const ComparedFigure found = compared(1.5, 12.0);
  EXPECT_NEAR(found.medianBefore, std::log(2.0), 1e-12);
  EXPECT_NEAR(found.medianAfter, std::log(4.0), 1e-12);
  EXPECT_EQ(found.worse, 1u);
  EXPECT_EQ(found.better, 0u);
  EXPECT_EQ(compared(12.0, 2.0).better, 1u);
  EXPECT_EQ(compared(3.0, 3.0).worse, 0u);
}

TEST(ComparedRuns, FiguresThatOneOfThemLacksAreNotCompared) {
  const Comparison c = compare({runWith({{"position_p99_m", 0.5}, {"update_ms_p50", 1.0}})},
                               {runWith({{"position_p99_m", kNan}, {"update_ms_p50", 2.0}})});
  EXPECT_EQ(figureIn(c, "position_p99_m"), nullptr);
  EXPECT_EQ(figureIn(c, "heading_rmse_deg"), nullptr);
  ASSERT_NE(figureIn(c, "update_ms_p50"), nullptr);
  EXPECT_EQ(figureIn(c, "update_ms_p50")->worse, 1u);
}

TEST(ComparedRuns, EventsOfCasesAreComparedOneByOne) {
  FiledRun before;
  before.kind = "wake-up";
  before.events = {{true, 4.0, 12}, {true, 6.0, 20}, {false, kNan, kNan}};
  FiledRun after = before;
  after.events = {{true, 3.0, 15}, {true, 6.0, 10}};  // an event less
  const Comparison c = compare({before}, {after});
  ASSERT_EQ(c.successes.size(), 1u);
  EXPECT_EQ(c.successes[0].name, "right, wake-up");
  EXPECT_EQ(c.successes[0].pairs, 2u);
  const ComparedFigure* seconds = figureIn(c, "case: after_s");
  ASSERT_NE(seconds, nullptr);
  EXPECT_EQ(seconds->better, 1u);
  EXPECT_EQ(seconds->worse, 0u);
  EXPECT_EQ(seconds->medianBefore, 5.0);
  EXPECT_EQ(seconds->medianAfter, 4.5);
  const ComparedFigure* readings = figureIn(c, "case: after_readings");
  ASSERT_NE(readings, nullptr);
  EXPECT_EQ(readings->better, 1u);
  EXPECT_EQ(readings->worse, 1u);
  EXPECT_EQ(readings->medianBefore, 16.0);
}

TEST(ComparedRuns, NeverLostMeansConvergedToo) {
  const Comparison c = compare({runWith({{"converged_after_s", kNan}}), runWith({})},
                               {runWith({{"lost_share", 0.005}}), runWith({})});
  ASSERT_EQ(c.successes.size(), 2u);
  EXPECT_EQ(c.successes[0].before, 1u);
  EXPECT_EQ(c.successes[0].after, 2u);
  EXPECT_EQ(c.successes[0].better, 1u);
  EXPECT_EQ(c.successes[1].name, "converged, never lost");
  EXPECT_EQ(c.successes[1].before, 1u);
  EXPECT_EQ(c.successes[1].after, 1u);
}

TEST(ComparedRuns, NamesSayAllThatMakesThemPairs) {
  FiledRun run = runWith({});
  EXPECT_EQ(run.name(), "record:run.rec, seed 3, robot.toml");
  run.start = "truth";
  run.faults = {"odometry=none", "readings=crowd"};
  EXPECT_EQ(run.name(),
            "record:run.rec, start truth, odometry=none, readings=crowd, seed 3, robot.toml");
  run.kind = "kidnap";
  run.number = 12;
  run.faults.clear();
  EXPECT_EQ(run.name(), "record:run.rec, kidnap 12, seed 3, robot.toml")
      << "a kidnap begins at the truth";
}

TEST(ComparedRuns, TheTextListsTwentyAndCountsTheOthers) {
  std::vector<FiledRun> before;
  std::vector<FiledRun> after;
  for (std::uint64_t seed = 1; seed <= 22; ++seed) {
    before.push_back(runWith({{"lost_share", 0.5}}));
    after.push_back(runWith({{"lost_share", 0.25}}));
    before.back().seed = after.back().seed = seed;
  }
  before.push_back(runWith({}));
  before.back().source = "record:a\nb.rec";
  const std::string text = toText(compare(before, after));
  EXPECT_TRUE(text.starts_with("22 pairs of runs\n"));
  EXPECT_NE(text.find("\nBetter: 22\n  record:run.rec, seed 1, robot.toml: lost for"), text.npos);
  EXPECT_NE(text.find(", seed 20, robot.toml: lost for 25.0 % instead of 50.0 % of the time\n"
                      "  and 2 more\n"),
            text.npos)
      << text;
  EXPECT_EQ(text.find("Worse"), text.npos);
  EXPECT_EQ(text.find("Only in B"), text.npos);
  EXPECT_NE(text.find("\nOnly in A: 1\n  record:a\\x0ab.rec, seed 3, robot.toml\n"), text.npos);
}

TEST(ComparedRuns, TheTextHasTheFiguresOfEachPairInColumns) {
  const std::string text = toText(
      compare({runWith({{"position_rmse_m", 0.25}})}, {runWith({{"position_rmse_m", 0.125}})}));
  EXPECT_NE(
      text.find(
          "success                       pairs        A        B  better   worse         p\n"
          "converged                         1        1        1       0       0         1\n"),
      text.npos)
      << text;
  EXPECT_NE(
      text.find(
          "figure, median                pairs        A        B  better   worse         p\n"),
      text.npos)
      << text;
  EXPECT_NE(
      text.find(
          "position_rmse_m                   1     0.25    0.125       1       0         1\n"),
      text.npos)
      << text;
}

TEST(ComparedRuns, JsonHasTheSameFigures) {
  std::vector<FiledRun> after = {runWith({{"position_rmse_m", 0.125}, {"lost_share", 0.5}})};
  after.push_back(runWith({}));
  after.back().seed = 4;
  const Comparison c = compare({runWith({{"position_rmse_m", 0.25}})}, after);
  const auto json = nlohmann::json::parse(toJson(c));
  EXPECT_EQ(json["pairs"], 1);
  EXPECT_EQ(json["only_a"], nlohmann::json::array());
  EXPECT_EQ(json["only_b"], nlohmann::json::array({"record:run.rec, seed 4, robot.toml"}));
  EXPECT_EQ(json["successes"][1],
            nlohmann::json::parse(R"({"name": "converged, never lost", "pairs": 1, "a": 1, "b": 0,
                                      "better": 0, "worse": 1, "p": 1.0})"));
  const auto isRmse = [](const nlohmann::json& one) { return one["name"] == "position_rmse_m"; };
  const auto rmse = std::ranges::find_if(json["figures"], isRmse);
  ASSERT_NE(rmse, json["figures"].end());
  EXPECT_EQ(*rmse,
            nlohmann::json::parse(R"({"name": "position_rmse_m", "pairs": 1, "median_a": 0.25,
                                      "median_b": 0.125, "better": 1, "worse": 0, "p": 1.0})"));
  EXPECT_EQ(json["changed"],
            nlohmann::json::parse(R"([{"run": "record:run.rec, seed 3, robot.toml", "better": false,
                                       "why": "lost for 50.0 % instead of 0.0 % of the time"}])"));
}

}  // namespace
}  // namespace ortung::app
