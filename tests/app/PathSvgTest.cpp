// Where a path of the report's map is broken, and the colours of quality.
#include <gtest/gtest.h>

#include <cmath>

#include "PathSvg.hpp"
#include "Report.hpp"
#include "SyntheticRun.hpp"

namespace ortung::app {
namespace {

struct Stop {
  double seconds;
  double x;
};

std::string commandsOf(const std::vector<Stop>& stops, double longestStep = 10.0) {
  std::vector<std::pair<Timestamp, Pose2>> poses;
  for (const Stop& stop : stops)
    poses.emplace_back(fromSeconds(stop.seconds), Pose2{stop.x, 0.5, 0.0});
  return pathCommands(poses, longestStep);
}

TEST(PathSvg, APointIsAMoveWithALineOfNoLengthAndFurtherOnesAreLines) {
  EXPECT_EQ(commandsOf({}), "");
  EXPECT_EQ(commandsOf({{0, 1.25}}), "M1.250 0.500h0");
  EXPECT_EQ(commandsOf({{0, 1}, {1, 2}, {2, -3.0004}}),
            "M1.000 0.500h0L2.000 0.500"
            "M-3.000 0.500h0");
}

// A jump is farther than 1 m and faster than 3 m/s.
TEST(PathSvg, ItIsBrokenAtStepsThatNoRobotCanDrive) {
  const auto isLine = [](double way, double seconds) {
    return commandsOf({{0, 0}, {seconds, way}}).find('L') != std::string::npos;
  };
  EXPECT_TRUE(isLine(0.99, 0.01)) << "fast, but near: noise of a coarse estimate";
  EXPECT_FALSE(isLine(1.01, 0.01));
  EXPECT_TRUE(isLine(2.9, 1.0)) << "far, but slow enough";
  EXPECT_FALSE(isLine(3.1, 1.0));
  EXPECT_TRUE(isLine(5.9, 2.0));
}

TEST(PathSvg, ItIsBrokenAtGapsThatAreLongerThanAskedForAndThanFiveUsualSteps) {
  EXPECT_EQ(commandsOf({{0, 0}, {0.1, 0}, {0.2, 0}, {2.2, 0}}, 2.0),
            "M0.000 0.500h0L0.000 0.500L0.000 0.500L0.000 0.500");
  EXPECT_EQ(commandsOf({{0, 0}, {0.1, 0}, {0.2, 0}, {2.3, 0}}, 2.0),
            "M0.000 0.500h0L0.000 0.500L0.000 0.500M0.000 0.500h0");
  // Steps of 1 s are usual here, so 5 s are no gap.
  EXPECT_EQ(commandsOf({{0, 0}, {1, 0}, {2, 0}, {7, 0}}, 2.0),
            "M0.000 0.500h0L0.000 0.500L0.000 0.500L0.000 0.500");
  EXPECT_EQ(commandsOf({{0, 0}, {1, 0}, {2, 0}, {7.1, 0}}, 2.0),
            "M0.000 0.500h0L0.000 0.500L0.000 0.500M0.000 0.500h0");
}

TEST(PathSvg, PosesThatAreNoNumbersAreLeftOut) {
  EXPECT_EQ(commandsOf({{0, 1}, {1, std::nan("")}, {2, 2}}), "M1.000 0.500h0L2.000 0.500");
}

TEST(PathSvg, LongPathsHaveAtMost20000Points) {
  std::vector<Stop> stops;
  for (int i = 0; i < 19999; ++i) stops.push_back({0.1 * i, 0.0});
  const auto points = [&] {
    const std::string commands = commandsOf(stops);
    return std::count(commands.begin(), commands.end(), ' ');
  };
  EXPECT_EQ(points(), 19999);
  stops.resize(45000, {5000.0, 0.0});
  EXPECT_EQ(points(), 15000) << "every third one";
}

std::vector<PoseEstimate> pathOf(const std::vector<double>& qualities) {
  std::vector<PoseEstimate> path;
  for (const double quality : qualities) {
    PoseEstimate& estimate = path.emplace_back();
    estimate.stamp = fromSeconds(0.1 * static_cast<double>(path.size()));
    estimate.pose = {0.1 * static_cast<double>(path.size()), 0.0, 0.0};
    estimate.quality = quality;
    estimate.status = TrackStatus::kTracking;
  }
  return path;
}

// The middle of the lowest of ten steps, 0.05, and of the highest, 0.95, between the colours of
// plasma: 240 + 0.35 (253 - 240) = 244.55, ...
constexpr const char* kLowest = "#f5e126";
constexpr const char* kHighest = "#1d078d";

TEST(PathSvg, QualityHasTenColours) {
  const auto colourAt = [](double quality) {
    const std::string svg = estimateSvg(pathOf({quality}), 1.0);
    const std::size_t at = svg.find("stroke=\"") + 8;
    return svg.substr(at, 7);
  };
  EXPECT_EQ(colourAt(0.0), kLowest);
  EXPECT_EQ(colourAt(0.099), kLowest);
  EXPECT_NE(colourAt(0.101), kLowest);
  EXPECT_EQ(colourAt(0.901), kHighest);
  EXPECT_EQ(colourAt(1.0), kHighest);
  EXPECT_EQ(colourAt(7.0), kHighest);
  EXPECT_EQ(colourAt(-1.0), kLowest);
  EXPECT_EQ(colourAt(std::nan("")), kLowest) << "what is not known is not trusted";
}

TEST(PathSvg, ALineHasTheColourOfThePointToWhichItLeads) {
  const std::string svg = estimateSvg(pathOf({1.0, 0.0, 0.0}), 1.0);
  EXPECT_NE(svg.find(std::string("stroke=\"") + kHighest + "\" d=\"M0.100 0.000h0\"/>"), svg.npos)
      << svg;
  EXPECT_NE(svg.find(std::string("stroke=\"") + kLowest +
                     "\" d=\"M0.100 0.000h0L0.200 0.000L0.300 0.000\"/>"),
            svg.npos)
      << svg;
}

TEST(PathSvg, TheLegendHasAllTenFromLeftToRight) {
  const std::string svg = qualityBar();
  EXPECT_NE(svg.find(R"(viewBox="0 0 10 1")"), svg.npos);
  EXPECT_NE(svg.find(std::string(R"(<rect x="0" width="1.02" height="1" fill=")") + kLowest),
            svg.npos);
  EXPECT_NE(svg.find(std::string(R"(<rect x="9" width="1.02" height="1" fill=")") + kHighest),
            svg.npos);
  EXPECT_EQ(svg.find(R"(x="10")"), svg.npos);
}

TEST(MapSvg, SaysWhatItShowsAndMarksBothEndsOfTheTruth) {
  RunResult run = syntheticRun();
  std::string svg = mapSvg(run);
  EXPECT_NE(svg.find("8 m by 6 m, 0 landmarks, 600 estimates beside the ground truth."), svg.npos);
  // 0.2 rad a second on a circle of 2 m: at 59.9 s at 11.98 rad.
  EXPECT_NE(svg.find(R"(<circle class="start" cx="2.000" cy="0.000" r="0.072"><title>start at )"
                     "2.000 m, 0.000 m</title>"),
            svg.npos);
  EXPECT_NE(svg.find(R"(<circle class="end" cx="1.666" cy="-1.107" r="0.072"><title>end at )"),
            svg.npos)
      << svg.substr(svg.find("<circle"));
  EXPECT_NE(svg.find(R"(class="now truth" r="0.101")"), svg.npos);
  EXPECT_NE(svg.find(R"(class="now estimate" r="0.058")"), svg.npos);
  run.figures.points.clear();
  svg = mapSvg(run);
  EXPECT_NE(svg.find("600 estimates.</desc>"), svg.npos);
  EXPECT_EQ(svg.find("class=\"start\""), svg.npos);
}

}  // namespace
}  // namespace ortung::app
