#include <gtest/gtest.h>

#include <cmath>

#include "DrawnMatrix.hpp"
#include "ortung/benchmark/MatrixPage.hpp"
#include "ortung/benchmark/Ratings.hpp"

namespace ortung {
namespace {

using test::drawn;

double points(double share) { return 400.0 * std::log10(share / (1.0 - share)); }

// With one striker the most likely ratings are its log odds.
TEST(Ratings, OfOneStrikerAreItsOdds) {
  const GoalMatrix matrix = drawn({{0.8}, {0.3}}, 4000, {strikerText("yardstick-v1")});
  const GoalRatings ratings = rate(matrix);
  EXPECT_EQ(ratings.strikers[0].points.value, 0.0);
  for (std::size_t k = 0; k < 2; ++k) {
    const double share = matrix.cell(k, 0).scoring().value;
    EXPECT_NEAR(ratings.keepers[k].points.value, -points(share), 0.3);
    EXPECT_EQ(ratings.keepers[k].scoring.value, share);
    // Of a share: +- 1.96 sqrt(p (1 - p) / n); of points: that times their slope.
    const double sigma = 400.0 / std::log(10.0) / std::sqrt(4000.0 * share * (1.0 - share));
    EXPECT_NEAR(ratings.keepers[k].points.high - ratings.keepers[k].points.low, 2 * 1.96 * sigma,
                0.2 * 2 * 1.96 * sigma);
  }
}

// A pair has half a goal before it has played, and half a save.
TEST(Ratings, OfFewEpisodesCountHalfAGoalAndHalfASaveMore) {
  const GoalRatings ratings = rate(drawn({{1.0}, {0.0}}, 4, {strikerText("yardstick-v1")}), 1);
  EXPECT_NEAR(ratings.keepers[0].points.value, -points(4.5 / 5.0), 1e-5);
  EXPECT_NEAR(ratings.keepers[1].points.value, -points(0.5 / 5.0), 1e-5);
}

TEST(Ratings, FindTheStrengthsThatEpisodesWereDrawnFrom) {
  const std::vector<double> keepers = {-0.7, 0.4, 1.5};
  const std::vector<double> strikers = {0.0, 0.9, -0.5, 0.3};
  std::vector<std::vector<double>> shares(3);
  for (std::size_t k = 0; k < 3; ++k)
    for (const double s : strikers) shares[k].push_back(1.0 / (1.0 + std::exp(keepers[k] - s)));
  const GoalRatings ratings =
      rate(drawn(shares, 3000, {strikerText("yardstick-v1"), "striker1", "striker2", "striker3"}));
  const double scale = 400.0 / std::log(10.0);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(ratings.keepers[k].points.value, scale * keepers[k], 25.0);
    EXPECT_LT(ratings.keepers[k].points.low, ratings.keepers[k].points.value);
    EXPECT_GT(ratings.keepers[k].points.high, ratings.keepers[k].points.value);
  }
  for (std::size_t s = 1; s < 4; ++s)
    EXPECT_NEAR(ratings.strikers[s].points.value, scale * strikers[s], 25.0);
  EXPECT_LT(std::abs(ratings.worstMiss), 0.03);
}

// Rock, paper, scissors have no strength, and it is said where that shows.
TEST(Ratings, SayWhereStrengthIsNotAll) {
  const GoalRatings ratings = rate(drawn({{0.9, 0.1}, {0.1, 0.9}}, 500, {"a", "b"}));
  EXPECT_GT(std::abs(ratings.worstMiss), 0.35);
  EXPECT_NEAR(ratings.strikers[0].points.value + ratings.strikers[1].points.value, 0.0, 1e-6)
      << "without the yardstick the mean of the strikers is 0";
}

TEST(Ratings, OfWhoNeverScoresAreFiniteAndTheSameEachTime) {
  const GoalMatrix matrix = drawn({{0.0, 1.0}, {0.0, 0.5}}, 200, {"a", "b"});
  const GoalRatings ratings = rate(matrix);
  for (const Rating& one : ratings.strikers) {
    EXPECT_TRUE(std::isfinite(one.points.value));
    EXPECT_TRUE(std::isfinite(one.points.low) && std::isfinite(one.points.high));
  }
  const GoalRatings again = rate(matrix);
  EXPECT_EQ(ratings.keepers[1].points.low, again.keepers[1].points.low);
  EXPECT_LT(ratings.strikers[0].points.high, ratings.strikers[1].points.low);
}

// One file that asks for no other, whatever players are called.
TEST(MatrixPage, NeedsNoOtherFileAndShowsEpisodes) {
  GoalMatrixConfig config;
  config.keepers = {keeperText("still"), keeperText("blocking")};
  config.strikers = {strikerText("shot")};
  config.episodes = 6;
  GoalMatrix matrix = playMatrix(config, {});
  const std::string html = toHtml(matrix, "1<2");
  EXPECT_TRUE(html.starts_with("<!doctype html>"));
  for (const char* outer : {"http", "src=", "href=", "url(", "@import", "<script"})
    EXPECT_EQ(html.find(outer), std::string::npos) << outer;
  EXPECT_NE(html.find("Ortung 1&lt;2"), std::string::npos);
  EXPECT_NE(html.find("prefers-color-scheme: dark"), std::string::npos);
  std::size_t pictures = 0;
  for (std::size_t at = html.find("<svg"); at != std::string::npos; at = html.find("<svg", at + 1))
    ++pictures;
  std::size_t outcomes = 0;
  for (const GoalCell& cell : matrix.cells)
    for (const GoalOutcome outcome : {GoalOutcome::kGoal, GoalOutcome::kSaved, GoalOutcome::kOut})
      outcomes += cell.count(outcome) > 0 ? 1 : 0;
  EXPECT_EQ(pictures, outcomes);
  EXPECT_EQ(html, toHtml(matrix, "1<2"));
}

TEST(MatrixPage, ShowsPoseErrorsWhereThereAreAny) {
  GoalMatrixConfig config;
  config.keepers = {keeperText("still")};
  config.strikers = {strikerText("roll")};
  config.episodes = 1;
  GoalMatrix matrix = playMatrix(config, {});
  PoseError& error = matrix.cells[0].episodes[0].keeper;
  const auto shows = [&](const char* text) {
    return toHtml(matrix, "1").find(text) != std::string::npos;
  };
  error = {};
  EXPECT_FALSE(shows("Pose error of the keeper")) << "it told no pose";
  error = {0, 0};
  EXPECT_FALSE(shows("Pose error of the keeper")) << "it saw by ground truth";
  error = {12'000, 34'907};  // 0.034907 rad are 2 degrees
  EXPECT_TRUE(shows("Pose error of the keeper"));
  EXPECT_TRUE(shows("<td>0.012 / 0.012<small>2.00\u00b0 on average"));
}

}  // namespace
}  // namespace ortung
