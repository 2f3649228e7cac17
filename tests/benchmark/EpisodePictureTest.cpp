#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <regex>

#include "EpisodePicture.hpp"

namespace ortung {
namespace {

/// A moment with the ball, the keeper and the striker at places that nothing else has.
GoalMoment momentAt(double x) {
  GoalMoment moment;
  moment.ball = {x, 1.0, 0.0};
  moment.keeper = {x - 1.0, -0.5, std::numbers::pi / 2.0};
  moment.striker = {x + 1.0, 2.0, std::numbers::pi};
  return moment;
}

// What was before the first move is no part of the episode: the striker makes its situation then.
const std::vector<GoalMoment> kMoments = {momentAt(3.0), momentAt(-2.0), momentAt(-3.0),
                                          momentAt(-4.0)};

/// A square of the picture, in the picture's own frame.
struct Square {
  double left = 0.0, top = 0.0, width = 0.0, height = 0.0, x = 0.0, y = 0.0, turn = 0.0;
};

Square squareOf(const std::string& svg, const std::string& style) {
  const std::regex form(
      "<rect x=\"([-.\\d]+)\" y=\"([-.\\d]+)\" width=\"([-.\\d]+)\" height=\"([-.\\d]+)\" "
      "transform=\"translate\\(([-.\\d]+) ([-.\\d]+)\\) rotate\\(([-.\\d]+)\\)\" class=\"" +
      style + "\"/>");
  std::smatch found;
  EXPECT_TRUE(std::regex_search(svg, found, form)) << style << " in " << svg;
  if (found.empty()) return {};
  const auto at = [&](std::size_t i) { return std::stod(found[i].str()); };
  return {at(1), at(2), at(3), at(4), at(5), at(6), at(7)};
}

// Seen from above with the goal, which is at negative x, at the bottom: y is to the right.
TEST(EpisodePicture, BodiesAreToScaleAroundTheirPoses) {
  const std::string svg = pictureOf(kMoments, "one");
  const auto expectAt = [&](const char* style, const Pose2& pose, double side) {
    SCOPED_TRACE(style);
    const Square square = squareOf(svg, style);
    EXPECT_DOUBLE_EQ(square.width, side);
    EXPECT_DOUBLE_EQ(square.height, side);
    EXPECT_DOUBLE_EQ(square.left, -side / 2.0) << "it turns about its middle";
    EXPECT_DOUBLE_EQ(square.top, -side / 2.0);
    EXPECT_DOUBLE_EQ(square.x, pose.y);
    EXPECT_DOUBLE_EQ(square.y, -pose.x);
    // Of who looks along x, up in the picture, the front is the side that is up.
    EXPECT_NEAR(std::cos(square.turn * std::numbers::pi / 180.0), std::sin(pose.theta), 1e-3);
    EXPECT_NEAR(std::sin(square.turn * std::numbers::pi / 180.0), std::cos(pose.theta), 1e-3);
  };
  expectAt("keeper from", kMoments[1].keeper, 0.45);  // robots/goalkeeper.toml: size_m
  expectAt("keeper body", kMoments[3].keeper, 0.45);
  expectAt("striker body", kMoments[3].striker, 0.5);  // robots/striker.toml: the longer side
}

TEST(EpisodePicture, HollowBallIsTheFirstAndTheFullOneTheLast) {
  const std::string svg = pictureOf(kMoments, "one");
  EXPECT_NE(svg.find("<circle class=\"ball from\" cx=\"1.00\" cy=\"2.00\" r=\"0.11\"/>"),
            std::string::npos)
      << svg;
  EXPECT_NE(svg.find("<circle class=\"ball body\" cx=\"1.00\" cy=\"4.00\" r=\"0.11\"/>"),
            std::string::npos)
      << svg;
}

// Each begins with the first move; places within 2 cm of the last one that is drawn are left out,
// but for the end.
TEST(EpisodePicture, PathsGoThroughAllPlacesFromTheFirstMoveOn) {
  std::vector<GoalMoment> moments = kMoments;
  moments.push_back(momentAt(-4.015));
  moments.push_back(momentAt(-4.03));
  moments.push_back(momentAt(-4.04));
  const std::string svg = pictureOf(moments, "one");
  for (const auto& [style, across, ahead] :
       {std::tuple{"ball", "1.00", 0.0}, {"keeper", "-0.50", 1.0}, {"striker", "2.00", -1.0}}) {
    std::string points;
    for (const double down : {2.0, 3.0, 4.0, 4.03, 4.04}) {
      char place[32];
      std::snprintf(place, sizeof place, "%s,%.2f ", across, down + ahead);
      points += place;
    }
    const std::string path =
        std::string("<polyline class=\"") + style + "\" points=\"" + points + "\"/>";
    EXPECT_NE(svg.find(path), std::string::npos) << path << "\nin " << svg;
  }
}

TEST(EpisodePicture, OfOneMomentOrNoneIsAPictureToo) {
  const std::string one = pictureOf({momentAt(-2.0)}, "one");
  EXPECT_DOUBLE_EQ(squareOf(one, "keeper from").y, 3.0);
  EXPECT_DOUBLE_EQ(squareOf(one, "keeper body").y, 3.0);
  const std::string none = pictureOf({}, "none");
  EXPECT_NE(none.find("<title>none</title>"), std::string::npos);
  EXPECT_EQ(none.find("<rect"), std::string::npos);
  EXPECT_TRUE(none.ends_with("</svg>"));
}

}  // namespace
}  // namespace ortung
