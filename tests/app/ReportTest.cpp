#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "Report.hpp"
#include "SyntheticRun.hpp"

namespace ortung::app {
namespace {

std::size_t countOf(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++count;
  return count;
}

nlohmann::json dataOf(const std::string& html) {
  const std::string begin = "id=\"data\">";
  const std::size_t from = html.find(begin) + begin.size();
  return nlohmann::json::parse(html.substr(from, html.find("</script>", from) - from));
}

TEST(Report, NeedsNothingFromTheNetwork) {
  const std::string html = toHtml(syntheticRun());
  EXPECT_EQ(countOf(html, "<link"), 0u);
  EXPECT_EQ(countOf(html, "src=\"http"), 0u);
  EXPECT_EQ(countOf(html, "@import"), 0u);
  EXPECT_NE(html.find("default-src 'none'"), std::string::npos);  // the browser sees to it, too
}

TEST(Report, EscapesEveryNameThatAFileOrCommandLineBrings) {
  RunResult run = syntheticRun();
  const std::string evil = "</script><script>alert('1')</script>\"&";
  run.figures.source = evil;
  run.robot = evil;
  run.tables = evil;
  run.commandLine = evil;
  run.tableInfo.world = evil;
  run.tableInfo.worldFingerprint = evil;
  const std::string html = toHtml(run);
  EXPECT_EQ(html.find("alert('1')"), std::string::npos);
  EXPECT_NE(html.find("&lt;script&gt;alert(&#39;1&#39;)"), std::string::npos);
  EXPECT_EQ(countOf(html, "<script"), 4u);  // data, dygraphs, its synchronizer, ours
}

TEST(Report, ShowsErrorsOverTimeSinceTheFirstReading) {
  RunResult run = syntheticRun();
  run.first = fromSeconds(-10.0);
  const nlohmann::json data = dataOf(toHtml(run));
  ASSERT_EQ(data["time"].size(), 600u);
  EXPECT_NEAR(data["time"][0].get<double>(), 10.0, 1e-3);
  EXPECT_NEAR(data["position"][0].get<double>(), 0.5, 1e-4);
  EXPECT_NEAR(data["heading"][0].get<double>(), 1.0, 1e-3);
  EXPECT_NEAR(data["positionSigma"][0].get<double>(), std::sqrt(0.008), 1e-4);
  EXPECT_EQ(data["samples"][0], 20000);
  EXPECT_EQ(data["converged"], 5.0);
}

TEST(Report, KeepsPeaksOfLongRuns) {
  RunResult run = syntheticRun();
  const EvaluationPoint point = run.figures.points.back();
  for (int i = 1; i < 50000; ++i) {
    run.figures.points.push_back(point);
    run.figures.points.back().stamp += 1000 * i;
    run.figures.points.back().positionError = i == 31415 ? 7.5 : 0.01;
  }
  const nlohmann::json data = dataOf(toHtml(run));
  EXPECT_LE(data["position"].size(), 10000u);
  EXPECT_EQ(std::count(data["position"].begin(), data["position"].end(), 7.5), 1);
}

TEST(Report, SaysSoIfThereIsNoGroundTruth) {
  RunResult run = syntheticRun();
  run.figures.points.clear();
  run.figures.convergedAfter.reset();
  const std::string html = toHtml(run);
  EXPECT_NE(html.find("no ground truth"), std::string::npos);
  EXPECT_EQ(html.find("id=\"position\""), std::string::npos);
  EXPECT_NE(html.find("id=\"samples\""), std::string::npos);
}

TEST(Report, SurvivesARunWithoutAnyUpdate) {
  RunResult run = syntheticRun();
  run.figures = {};
  run.estimates.clear();
  EXPECT_EQ(dataOf(toHtml(run))["samples"].size(), 0u);
}

TEST(Report, CarriesTheLicenceOfItsCharts) {
  const std::string html = toHtml(syntheticRun());
  EXPECT_NE(html.find("Dan Vanderkam"), std::string::npos);
  EXPECT_NE(html.find("(MIT)"), std::string::npos);
}

TEST(Report, MapHasBothPathsBreaksThemAtJumpsAndLiesRightSideUp) {
  RunResult run = syntheticRun();
  run.estimates.resize(2);
  run.estimates[0].pose = {1.0, 2.0, 0.0};
  run.estimates[1].pose = {-3.0, 2.0, 0.0};  // 4 m in 0.1 s: not driven
  const std::string svg = mapSvg(run);
  EXPECT_NE(svg.find("M1.000 2.000h0M-3.000 2.000h0"), std::string::npos);
  EXPECT_NE(svg.find("viewBox=\"-4.000 -3.000 8.000"), std::string::npos);
  EXPECT_NE(svg.find("data:image/png;base64,iVBORw0KGgo"), std::string::npos);  // PNG's signature
  EXPECT_EQ(countOf(svg, "class=\"truth\""), 1u);
  run.estimates[1].stamp = fromSeconds(4.0);  // 1 m/s: a log with rare scans
  EXPECT_NE(mapSvg(run).find("M1.000 2.000h0L-3.000 2.000"), std::string::npos);
}

}  // namespace
}  // namespace ortung::app
