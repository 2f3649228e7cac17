#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "Palette.hpp"
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
  EXPECT_EQ(countOf(html, "<script"), 3u);  // data, uPlot, ours
  EXPECT_EQ(countOf(html, "</script"), 3u);
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

TEST(Report, ShowsTheBoundBesideErrorsIfThereIsOne) {
  RunResult run = syntheticRun();
  EXPECT_TRUE(dataOf(toHtml(run))["positionBound"].empty());
  EXPECT_EQ(toHtml(run).find("its lower bound"), std::string::npos);
  const Timestamp later = run.figures.points[10].stamp;
  run.bounds = {{run.figures.points[1].stamp, {0.0009, 0, 0, 0, 0.0016, 0, 0, 0, 0.0}},
                {later, {0.0036, 0, 0, 0, 0.0064, 0, 0, 0, 0.0001}}};
  const nlohmann::json data = dataOf(toHtml(run));
  ASSERT_EQ(data["positionBound"].size(), 600u);
  EXPECT_TRUE(data["positionBound"][0].is_null());  // nothing was known then
  EXPECT_NEAR(data["positionBound"][1].get<double>(), 0.05, 1e-6);
  EXPECT_NEAR(data["positionBound"][9].get<double>(), 0.05, 1e-6);
  EXPECT_NEAR(data["positionBound"][10].get<double>(), 0.1, 1e-6);
  EXPECT_NEAR(data["headingBound"][599].get<double>(), 0.573, 1e-3);
  EXPECT_EQ(countOf(toHtml(run), "its lower bound (green)"), 2u);
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
  run.path.clear();
  EXPECT_EQ(dataOf(toHtml(run))["samples"].size(), 0u);
}

TEST(Report, CarriesTheLicenceOfItsCharts) {
  const std::string html = toHtml(syntheticRun());
  EXPECT_NE(html.find("Leon Sorokin"), std::string::npos);
  EXPECT_NE(html.find("The above copyright notice and this permission notice"), std::string::npos);
}

TEST(Report, MapHasBothPathsBreaksThemAtJumpsAndLiesRightSideUp) {
  RunResult run = syntheticRun();
  run.path.resize(2);
  run.path[0].pose = {1.0, 2.0, 0.0};
  run.path[1].pose = {-3.0, 2.0, 0.0};  // 4 m in 0.1 s: not driven
  const std::string svg = mapSvg(run);
  EXPECT_NE(svg.find("M1.000 2.000h0M-3.000 2.000h0"), std::string::npos);
  EXPECT_NE(svg.find("data:image/png;base64,iVBORw0KGgo"), std::string::npos);  // PNG's signature
  EXPECT_EQ(countOf(svg, "class=\"truth\""), 1u);
  run.path[1].stamp = fromSeconds(4.0);  // 1 m/s: a log with rare scans
  EXPECT_NE(mapSvg(run).find("M1.000 2.000h0L-3.000 2.000"), std::string::npos);
}

TEST(Report, NeitherPathHidesTheOther) {
  const std::string svg = mapSvg(syntheticRun());
  EXPECT_LT(svg.find("class=\"truth\""), svg.find("class=\"estimate\""))
      << "the thin estimate lies above the broad truth";
}

/// The `d` of all paths with the attributes, one after the other.
std::string commandsOf(const std::string& svg, const std::string& attributes) {
  std::string commands;
  const std::string begin = "<path " + attributes + " d=\"";
  for (std::size_t at = svg.find(begin); at != svg.npos; at = svg.find(begin, at + 1)) {
    const std::size_t from = at + begin.size();
    commands += svg.substr(from, svg.find('"', from) - from);
  }
  return commands;
}

/// The attributes of what is coloured as of that quality.
std::string qualityOf(double share) {
  const Colour c = palette::quality(share);
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), R"(class="quality" stroke="#%02x%02x%02x")", c.red,
                c.green, c.blue);
  return text.data();
}

/// Moments 1 m and 1 s apart on the x axis, of these qualities.
RunResult runOfQualities(std::vector<double> qualities) {
  RunResult run = syntheticRun();
  run.path.resize(qualities.size());
  for (std::size_t i = 0; i < qualities.size(); ++i) {
    run.path[i].stamp = fromSeconds(static_cast<double>(i));
    run.path[i].pose = {static_cast<double>(i) - 2.0, 0.0, 0.0};
    run.path[i].quality = qualities[i];
    run.path[i].status = TrackStatus::kTracking;
  }
  return run;
}

TEST(Report, ThePathIsColouredByQuality) {
  const std::string svg = mapSvg(runOfQualities({1.0, 0.97, 0.32, 0.35, 0.0}));
  EXPECT_EQ(commandsOf(svg, qualityOf(0.95)), "M-2.000 0.000h0L-1.000 0.000")
      << "up to the last sure pose";
  EXPECT_EQ(commandsOf(svg, qualityOf(0.35)), "M-1.000 0.000h0L0.000 0.000L1.000 0.000")
      << "a line has the quality of where it leads to";
  EXPECT_EQ(commandsOf(svg, qualityOf(0.05)), "M1.000 0.000h0L2.000 0.000");
  EXPECT_EQ(countOf(svg, "class=\"quality\""), 3u);
  EXPECT_EQ(commandsOf(svg, R"(class="estimate")"),
            "M-2.000 0.000h0L-1.000 0.000L0.000 0.000L1.000 0.000L2.000 0.000");
}

TEST(Report, EachStatusThatIsNotTrackingIsMarkedBelowThePaths) {
  RunResult run = runOfQualities({0.99, 0.7, 0.4, 0.3, 0.99});
  EXPECT_EQ(countOf(mapSvg(run), "class=\"uncertain\""), 0u);
  run.path[1].status = TrackStatus::kUncertain;
  run.path[2].status = run.path[3].status = TrackStatus::kLost;
  const std::string svg = mapSvg(run);
  EXPECT_EQ(commandsOf(svg, R"(class="uncertain")"), "M-2.000 0.000h0L-1.000 0.000");
  EXPECT_EQ(commandsOf(svg, R"(class="lost")"), "M-1.000 0.000h0L0.000 0.000L1.000 0.000");
  EXPECT_EQ(countOf(svg, "class=\"tracking\""), 0u);
  EXPECT_LT(svg.find("class=\"lost\""), svg.find("class=\"estimate\""));
  EXPECT_EQ(countOf(toHtml(run), "key uncertain"), 1u);
  EXPECT_EQ(countOf(toHtml(run), "key lost"), 1u);
}

TEST(Report, TheColoursOfQualityGrowDarkerEvenly) {
  double last = 1e9;
  for (int i = 0; i <= 20; ++i) {
    const Colour c = palette::quality(0.05 * i);
    const double grey = 0.2126 * c.red + 0.7152 * c.green + 0.0722 * c.blue;  // Rec. 709
    EXPECT_LT(grey, last - 2.0) << i;
    last = grey;
  }
}

TEST(Report, QualityAndStatusOverTimeAreThereWithoutTruthAndInWords) {
  RunResult run = runOfQualities({0.99, 0.7, 0.4});
  run.path[1].status = TrackStatus::kUncertain;
  run.path[1].reason = TrackReason::kSeveralPlaces;
  run.path[2].status = TrackStatus::kLost;
  run.path[2].reason = TrackReason::kOdometry;
  run.figures.points.clear();
  const std::string html = toHtml(run);
  EXPECT_NE(html.find("id=\"quality\""), std::string::npos);
  const nlohmann::json data = dataOf(html);
  EXPECT_EQ(data["pathTime"], nlohmann::json({0, 1, 2}));
  EXPECT_EQ(data["quality"], nlohmann::json({0.99, 0.7, 0.4}));
  EXPECT_EQ(data["statusNames"][data["status"][1].get<int>()], "uncertain");
  EXPECT_EQ(data["reasonNames"][data["reason"][1].get<int>()], "several places fit");
  EXPECT_EQ(data["statusNames"][data["status"][2].get<int>()], "lost");
  EXPECT_EQ(data["reasonNames"][data["reason"][2].get<int>()], nameOf(TrackReason::kOdometry));
}

TEST(Report, LongPathsKeepMomentsWithoutTrust) {
  RunResult run = runOfQualities(std::vector<double>(100001, 0.99));
  for (std::size_t i = 0; i < run.path.size(); ++i) run.path[i].pose.x = 1e-5 * double(i);
  run.path[70001].status = TrackStatus::kLost;
  run.path[70001].quality = 0.05;
  const std::string svg = mapSvg(run);
  EXPECT_EQ(countOf(commandsOf(svg, R"(class="lost")"), "L"), 1u);
  EXPECT_EQ(countOf(commandsOf(svg, qualityOf(0.05)), "L"), 1u);
  const nlohmann::json data = dataOf(toHtml(run));
  EXPECT_EQ(std::count(data["status"].begin(), data["status"].end(), 2), 1);
}

TEST(Report, APathOfRareUpdatesIsALineAlthoughMomentsLieClose) {
  RunResult run = syntheticRun();
  run.path.clear();
  run.estimates.resize(20);
  for (std::size_t i = 0; i < 20; ++i) {  // an update every 2 s, and moments before each of them
    run.estimates[i].stamp = fromSeconds(2.0 * static_cast<double>(i));
    for (int moment = 4; moment >= 0; --moment) {
      run.path.push_back(run.estimates[i]);
      run.path.back().stamp -= fromSeconds(0.1 * moment);
    }
  }
  for (std::size_t i = 0; i < 20; ++i) run.figures.points[i].stamp = run.estimates[i].stamp;
  run.figures.points.resize(20);
  EXPECT_EQ(countOf(commandsOf(mapSvg(run), R"(class="estimate")"), "M"), 1u);
  run.figures.points.clear();
  EXPECT_EQ(countOf(commandsOf(mapSvg(run), R"(class="estimate")"), "M"), 1u);
}

TEST(Report, PathsAndChartsBreakAtGaps) {
  RunResult run = syntheticRun();
  for (std::size_t i = 300; i < 600; ++i) {  // 20 s without any reading
    run.path[i].stamp += fromSeconds(20.0);
    run.figures.points[i].stamp += fromSeconds(20.0);
  }
  const std::string svg = mapSvg(run);
  const auto pathOf = [&](const std::string& kind) {
    const std::size_t from = svg.find("class=\"" + kind + "\" d=\"");
    return svg.substr(from, svg.find('>', from) - from);
  };
  EXPECT_EQ(countOf(pathOf("truth"), "M"), 2u);
  EXPECT_EQ(countOf(pathOf("estimate"), "M"), 2u);
  EXPECT_EQ(dataOf(toHtml(run))["longestStep"], 1.0);
}

TEST(Report, MapHasAxesInMetres) {
  const std::string svg = mapSvg(syntheticRun());  // x from -4 to 4 m, y from -3 to 3 m
  for (const char* text : {"x [m]", "y [m]", ">-4<", ">0<", ">3<", ">1 m<"})
    EXPECT_NE(svg.find(text), std::string::npos) << text;
  // The field's rectangle lies within what is shown, with equal scales: no other than the viewBox.
  EXPECT_EQ(svg.find("preserveAspectRatio=\"none\" viewBox"), std::string::npos);
  double x = 0.0;
  double y = 0.0;
  double width = 0.0;
  double height = 0.0;
  ASSERT_EQ(std::sscanf(svg.c_str() + svg.find("viewBox"), "viewBox=\"%lf %lf %lf %lf\"", &x, &y,
                        &width, &height),
            4);
  EXPECT_LT(x, -4.0);
  EXPECT_LT(y, -3.0);
  EXPECT_GT(x + width, 4.0);
  EXPECT_GT(y + height, 3.0);
}

TEST(Report, MapShowsLandmarksAndLinesOfTheField) {
  RunResult run = syntheticRun();
  EXPECT_EQ(countOf(mapSvg(run), "class=\"landmark\""), 0u);
  EXPECT_EQ(countOf(toHtml(run), "key landmark"), 0u) << "the legend names what is there";
  run.tableInfo.field.landmarks = {{7, "post", 1.5, -2.0, 0.4}, {8, "<b>", -1.0, 2.0, 0.4}};
  FieldLine line;
  line.x0 = -3.0;
  line.y0 = 1.0;
  line.x1 = 3.0;
  line.y1 = 1.0;
  FieldLine circle;
  circle.shape = FieldLine::Shape::kArc;
  circle.radiusX = circle.radiusY = 1.0;
  circle.to = 6.283185307179586;
  run.tableInfo.field.lines = {line, circle};
  const std::string svg = mapSvg(run);
  EXPECT_EQ(countOf(svg, "class=\"landmark\""), 2u);
  EXPECT_NE(svg.find("<title>post 7 at 1.500 m, -2.000 m</title>"), std::string::npos);
  EXPECT_NE(svg.find("&lt;b&gt; 8"), std::string::npos);
  EXPECT_EQ(svg.find("<b>"), std::string::npos);
  EXPECT_NE(svg.find("M-3.000 1.000L3.000 1.000"), std::string::npos);
  EXPECT_NE(svg.find("M1.000 0.000L"), std::string::npos) << "the circle begins on its right";
  EXPECT_EQ(countOf(toHtml(run), "key landmark"), 1u);
}

TEST(Report, ReadersOfScreensHearWhatIsDrawn) {
  const std::string html = toHtml(syntheticRun());
  EXPECT_NE(html.find("<title id=\"map-title\">Map with paths</title>"), std::string::npos);
  EXPECT_NE(html.find("aria-label=\"Position error over time. Position error, RMS: 0.100 m."),
            std::string::npos);
  EXPECT_EQ(countOf(html, "class=\"chart\" role=\"img\""), 4u);
}

TEST(Report, HasADarkSchemeForAllItsColours) {
  const std::string html = toHtml(syntheticRun());
  const std::size_t dark = html.find("@media (prefers-color-scheme: dark)");
  ASSERT_NE(dark, std::string::npos);
  const std::string light = html.substr(html.find(":root"), dark - html.find(":root"));
  const std::string darkRoot = html.substr(dark, html.find("\n}", dark) - dark);
  for (std::size_t at = light.find(" --"); at != light.npos; at = light.find(" --", at + 1)) {
    const std::string name = light.substr(at + 1, light.find(':', at) - at);
    EXPECT_NE(darkRoot.find(name), std::string::npos) << name;
  }
}

}  // namespace
}  // namespace ortung::app
