// Episodes as pictures: a unit of the picture is a metre, the goal is at its bottom.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "EpisodePicture.hpp"

namespace ortung {
namespace {

/// The ball rolls towards the goal, the keeper goes aside; at first nobody is where he plays.
std::vector<GoalMoment> moments(std::size_t count) {
  std::vector<GoalMoment> all;
  for (std::size_t i = 0; i < count; ++i) {
    const double t = static_cast<double>(i);
    GoalMoment moment;
    moment.ball = {-3.0 - t, 0.5, 0.0};
    moment.keeper = {-5.5, 0.25 * t, std::numbers::pi / 2.0};
    moment.striker = {-2.0, 1.0 + 0.5 * t, std::numbers::pi};
    all.push_back(moment);
  }
  return all;
}

/// What is drawn of a class: "<rect ...", up to its end.
std::string element(const std::string& svg, const std::string& style) {
  const std::size_t at = svg.find("class=\"" + style + "\"");
  if (at == svg.npos) return "";
  const std::size_t begin = svg.rfind('<', at);
  return svg.substr(begin, svg.find('>', at) - begin);
}

double attribute(const std::string& element, const std::string& name) {
  const std::size_t at = element.find(" " + name + "=\"");
  return at == element.npos ? NAN : std::stod(element.substr(at + name.size() + 3));
}

/// A robot's body: a square around its middle, where it stands, turned as it is.
void expectBody(const std::string& drawn, const Pose2& pose, double width) {
  EXPECT_NEAR(attribute(drawn, "width"), width, 1e-9) << drawn;
  EXPECT_NEAR(attribute(drawn, "height"), width, 1e-9) << drawn;
  EXPECT_NEAR(attribute(drawn, "x"), -width / 2, 1e-9) << drawn;
  EXPECT_NEAR(attribute(drawn, "y"), -width / 2, 1e-9) << drawn;
  char place[80];
  std::snprintf(place, sizeof place, "translate(%.3f %.3f) rotate(%.1f)", pose.y, -pose.x,
                90.0 - pose.theta * 180.0 / std::numbers::pi);
  EXPECT_NE(drawn.find(place), std::string::npos) << drawn << ", expected " << place;
}

TEST(EpisodePicture, ShowsFromWhereToWhereAllHaveGone) {
  for (const std::size_t count : {1u, 2u, 3u, 5u}) {
    const std::vector<GoalMoment> all = moments(count);
    const std::string svg = pictureOf(all, "saved");
    // The first moment is before the players have taken their places.
    const GoalMoment& first = all[count > 1 ? 1 : 0];
    expectBody(element(svg, "keeper from"), first.keeper, 0.45);
    expectBody(element(svg, "keeper body"), all.back().keeper, 0.45);
    expectBody(element(svg, "striker body"), all.back().striker, 0.5);
    EXPECT_NEAR(attribute(element(svg, "ball from"), "cy"), -first.ball.x, 1e-9);
    EXPECT_NEAR(attribute(element(svg, "ball body"), "cy"), -all.back().ball.x, 1e-9);
    EXPECT_NEAR(attribute(element(svg, "ball body"), "cx"), 0.5, 1e-9);
    const std::string way = element(svg, "ball");
    EXPECT_EQ(static_cast<std::size_t>(std::count(way.begin(), way.end(), ',')),
              count > 1 ? count - 1 : 1)
        << way;
    EXPECT_NE(svg.find("<title>saved</title>"), std::string::npos);
  }
}

TEST(EpisodePicture, LeavesOutPlacesWithinTwoCentimetresButNotTheLast) {
  std::vector<GoalMoment> all = moments(2);
  for (int i = 0; i < 9; ++i) {
    all.push_back(all.back());
    all.back().ball.x -= 0.01;
  }
  // From -4.00, each 0.01 farther: -4.02 (or -4.03), ..., -4.09.
  const std::string way = element(pictureOf(all, ""), "ball");
  EXPECT_NE(way.find("0.50,4.00 "), std::string::npos) << way;
  EXPECT_NE(way.find("0.50,4.09 "), std::string::npos) << way;
  EXPECT_LE(std::count(way.begin(), way.end(), ','), 6) << way;
  EXPECT_GE(std::count(way.begin(), way.end(), ','), 4) << way;
}

TEST(EpisodePicture, OfNothingIsTheField) {
  const std::string svg = pictureOf({}, "nothing");
  EXPECT_NE(svg.find("class=\"goal\""), std::string::npos);
  EXPECT_EQ(element(svg, "ball body"), "");
  EXPECT_TRUE(svg.ends_with("</svg>"));
}

}  // namespace
}  // namespace ortung
