#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "Comparison.hpp"
#include "Files.hpp"
#include "Golden.hpp"
#include "ManyRuns.hpp"
#include "RunResult.hpp"
#include "SyntheticRun.hpp"

namespace ortung::app {
namespace {

using test::messageOf;
using test::TemporaryFolder;

/// Of ten runs the second one has half the error, but the ninth and tenth, which are lost.
std::vector<FiledRun> tenRuns(bool isAfter) {
  std::vector<FiledRun> runs;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    FiledRun run;
    run.source = "record:run.rec";
    run.robot = "robot.toml";
    run.seed = seed;
    const bool isLost = isAfter && seed > 8;
    const double error = 0.1 + 0.01 * static_cast<double>(seed);
    run.figures = {{"converged_after_s", 1.0},
                   {"lost_share", isLost ? 0.25 : 0.0},
                   {"position_median_m", isAfter ? (isLost ? 3 : 0.5) * error : error}};
    runs.push_back(run);
  }
  return runs;
}

const ComparedFigure& figureOf(const Comparison& comparison, const std::string& name) {
  for (const ComparedFigure& figure : comparison.figures)
    if (figure.name == name) return figure;
  throw std::runtime_error("no figure " + name);
}

TEST(Comparison, CountsPairsThatGotBetterAndWorse) {
  const Comparison c = compare(tenRuns(false), tenRuns(true));
  EXPECT_EQ(c.pairs, 10u);
  const ComparedFigure& median = figureOf(c, "position_median_m");
  EXPECT_EQ(median.pairs, 10u);
  EXPECT_EQ(median.better, 8u);
  EXPECT_EQ(median.worse, 2u);
  EXPECT_NEAR(median.medianBefore, 0.155, 1e-12);
  // The two that are worse have the ranks 9 and 10: the sums are 19 and 36, and of 1024 cases 211
  // have 19 or less (tables of the signed-rank statistic, n = 10).
  EXPECT_NEAR(median.p, 2 * 211 / 1024.0, 0.03);
  ASSERT_EQ(c.successes.size(), 2u);
  EXPECT_EQ(c.successes[0].name, "converged");
  EXPECT_EQ(c.successes[0].p, 1.0);
  EXPECT_EQ(c.successes[1].before, 10u);
  EXPECT_EQ(c.successes[1].after, 8u);
  EXPECT_EQ(c.successes[1].worse, 2u);
  EXPECT_DOUBLE_EQ(c.successes[1].p, 0.5);
  ASSERT_EQ(c.changed.size(), 2u);
  EXPECT_FALSE(c.changed[0].isBetter);
  EXPECT_EQ(c.changed[0].name, "record:run.rec, seed 9, robot.toml");
  EXPECT_EQ(c.changed[0].why, "lost for 25.0 % instead of 0.0 % of the time");
}

TEST(Comparison, OfTheSameRunsFindsNothing) {
  const Comparison c = compare(tenRuns(true), tenRuns(true));
  EXPECT_TRUE(c.changed.empty());
  for (const ComparedFigure& figure : c.figures) EXPECT_EQ(figure.p, 1.0) << figure.name;
  for (const ComparedSuccess& success : c.successes) EXPECT_EQ(success.p, 1.0) << success.name;
}

TEST(Comparison, PairsAreOfTheSameSourceRobotSeedFaultsAndCase) {
  const FiledRun run = tenRuns(false).front();
  std::vector<FiledRun> others(7, run);
  others[0].source = "record:other.rec";
  others[1].robot = "other.toml";
  others[2].seed = 99;
  others[3].faults = {"odometry=none"};
  others[4].kind = "kidnap";
  others[5].kind = "kidnap";
  others[5].number = 2;
  others[6].start = "truth";
  for (const FiledRun& other : others) EXPECT_EQ(compare({run}, {other}).pairs, 0u) << other.name();
  const Comparison c = compare({run, others[4]}, {others[4], others[5], run, others[2]});
  EXPECT_EQ(c.pairs, 2u);
  EXPECT_TRUE(c.onlyBefore.empty());
  EXPECT_EQ(c.onlyAfter.size(), 2u);
  EXPECT_EQ(compare({run, run, run}, {run, run}).onlyBefore.size(), 1u);
}

TEST(Comparison, CasesThatFoundTheirPlaceOnceAreTold) {
  FiledRun before;
  before.kind = "kidnap";
  before.events = {{false, std::nan(""), std::nan("")}, {true, 4.0, 12}};
  FiledRun after = before;
  after.events = {{true, 3.0, 10}, {true, 2.0, 6}};
  const Comparison c = compare({before}, {after});
  ASSERT_EQ(c.successes.size(), 1u);
  EXPECT_EQ(c.successes[0].name, "right, kidnap");
  EXPECT_EQ(c.successes[0].pairs, 2u);
  EXPECT_EQ(c.successes[0].better, 1u);
  EXPECT_EQ(figureOf(c, "case: after_s").pairs, 1u) << "those that were right both times";
  EXPECT_EQ(figureOf(c, "case: after_s").better, 1u);
  ASSERT_EQ(c.changed.size(), 1u);
  EXPECT_TRUE(c.changed[0].isBetter);
}

TEST(Comparison, TextAndJsonTellTheSame) {
  const Comparison c = compare(tenRuns(false), tenRuns(true));
  const std::string text = toText(c);
  EXPECT_NE(text.find("Worse: 2\n  record:run.rec, seed 9, robot.toml: lost for 25.0 %"), text.npos)
      << text;
  EXPECT_EQ(text.find("Only in"), text.npos);
  const auto json = nlohmann::json::parse(toJson(c));
  EXPECT_EQ(json["pairs"], 10);
  EXPECT_EQ(json["successes"][1]["worse"], 2);
  EXPECT_EQ(json["changed"].size(), 2u);
}

class RunFiles : public testing::Test {
 protected:
  std::string refusal(const std::string& text) const {
    test::writeBytes(folder / "x.json", text);
    const std::string message = messageOf<std::runtime_error>([&] { readRuns(folder / "x.json"); });
    EXPECT_TRUE(message.starts_with((folder / "x.json").string())) << message;
    return message;
  }
  TemporaryFolder folder;
};

TEST_F(RunFiles, AreReadAsTheyWereWritten) {
  RunResult run = syntheticRun();
  run.kind = RunKind::kKidnap;
  run.number = 4;
  run.faults = {"odometry=none"};
  run.events = {{.place = {}, .isRight = true, .after = 2.5, .travelled = 1, .readings = 7},
                CaseEvent()};
  test::writeBytes(folder / "one.json", toJson(run));
  test::writeBytes(folder / "many.json", toJson(std::vector<RunResult>{run, run}));
  EXPECT_EQ(readRuns(folder / "many.json").size(), 2u);
  const FiledRun read = readRuns(folder / "one.json").at(0);
  EXPECT_EQ(read.source, "record:circle.rec");
  EXPECT_EQ(read.seed, 7u);
  EXPECT_EQ(read.kind, "kidnap");
  EXPECT_EQ(read.number, 4u);
  EXPECT_EQ(read.faults, run.faults);
  EXPECT_EQ(read.figures.at("converged_after_s"), 5.0);
  ASSERT_EQ(read.events.size(), 2u);
  EXPECT_EQ(read.events[0].after, 2.5);
  EXPECT_EQ(read.events[0].readings, 7.0);
  EXPECT_FALSE(read.events[1].isRight);
  EXPECT_TRUE(std::isnan(read.events[1].after));
}

TEST_F(RunFiles, OfEarlierVersionsAreRead) {
  for (const char* file :
       {"result.json", "result-2.json", "result-3.json", "result-4.json", "result-5.json"})
    EXPECT_EQ(readRuns(test::goldenFile(file)).size(), 1u) << file;
}

TEST_F(RunFiles, OthersAreRefusedWithWhatWasExpected) {
  EXPECT_NE(refusal("").find("is not JSON"), std::string::npos);
  EXPECT_NE(refusal("{\"a\": 1").find("is not JSON"), std::string::npos);
  EXPECT_NE(refusal("[]").find("found array, expected an object"), std::string::npos);
  EXPECT_NE(refusal("{}").find("has no key 'source'"), std::string::npos);
  EXPECT_NE(refusal(R"({"source": 1})").find("'source' is number, expected text"),
            std::string::npos);
  EXPECT_NE(refusal(R"({"runs": {}})").find("'runs' is object, expected a list"),
            std::string::npos);
  EXPECT_NE(refusal(R"({"runs": [3]})").find("run 1: found number"), std::string::npos);
  const std::string begin = R"({"source": "a", "robot": "b", "seed": )";
  EXPECT_NE(refusal(begin + "-1}").find("'seed' is number, expected a whole number"),
            std::string::npos);
  EXPECT_NE(refusal(begin + "1, \"faults\": [1]}").find("a fault is not text"), std::string::npos);
  EXPECT_NE(refusal(begin + "1, \"case\": 5}").find("case: found number"), std::string::npos);
  EXPECT_NE(refusal(begin + R"(1, "case": {"kind": "kidnap", "number": 1, "events": [{}]}})")
                .find("event 1: has no key 'right'"),
            std::string::npos);
  EXPECT_NE(refusal(begin + "1}").find("has no key 'converged_after_s'"), std::string::npos);
  EXPECT_NE(refusal(begin + "1, \"converged_after_s\": \"soon\"}").find("a number or null"),
            std::string::npos);
  EXPECT_NE(
      messageOf<std::runtime_error>([&] { readRuns(folder / "none.json"); }).find("none.json: "),
      std::string::npos);
}

}  // namespace
}  // namespace ortung::app
