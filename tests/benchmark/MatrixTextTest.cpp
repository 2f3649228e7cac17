#include <gtest/gtest.h>

#include <array>
#include <iterator>
#include <sstream>

#include "ortung/benchmark/GoalMatrix.hpp"
#include "ortung/benchmark/MatrixPage.hpp"

namespace ortung {
namespace {

/// Results that nobody played. @param goals of ten episodes, against still by roll and shot, and
/// against random by roll and shot
GoalMatrix matrixOf(const std::array<std::size_t, 4>& goals) {
  GoalMatrix matrix;
  matrix.config.keepers = {keeperText("still"), keeperText("random")};
  matrix.config.strikers = {strikerText("roll"), strikerText("shot")};
  matrix.config.episodes = 10;
  matrix.config.seed = 3;
  for (std::size_t pair = 0; pair < 4; ++pair) {
    GoalCell cell{matrix.config.keepers[pair / 2], matrix.config.strikers[pair % 2], {}};
    for (std::size_t i = 0; i < 10; ++i) {
      GoalEpisode episode;
      episode.outcome = i < goals[pair] ? GoalOutcome::kGoal : GoalOutcome::kTime;
      episode.end = i < goals[pair] ? 2'500'000 : GoalEpisodes::kLongest;
      cell.episodes.push_back(episode);
    }
    matrix.cells.push_back(std::move(cell));
  }
  return matrix;
}

/// The lines behind the one that begins with a title, up to an empty one.
std::vector<std::string> linesBehind(const std::string& text, const std::string& title) {
  std::vector<std::string> lines;
  std::istringstream in(text.substr(std::min(text.find(title), text.size())));
  for (std::string line; std::getline(in, line) && (lines.empty() || !line.empty());)
    lines.push_back(line);
  if (!lines.empty()) lines.erase(lines.begin());
  return lines;
}

/// The words of a line.
std::vector<std::string> wordsOf(const std::string& line) {
  std::istringstream in(line);
  return {std::istream_iterator<std::string>(in), {}};
}

using Words = std::vector<std::string>;

TEST(MatrixText, TablesHaveARowForEachKeeperAndAColumnForEachStriker) {
  const std::string text = toText(matrixOf({8, 2, 6, 0}));
  EXPECT_TRUE(text.starts_with("10 episodes a pair, seed 3\n")) << text;
  const auto goals = linesBehind(text, "goals of 100 episodes [95 %]");
  ASSERT_EQ(goals.size(), 3u) << text;
  EXPECT_EQ(wordsOf(goals[0]), (Words{"keeper", "roll", "shot"}));
  // Wilson's intervals of 8, 2, 6 and 0 of 10.
  EXPECT_EQ(wordsOf(goals[1]),
            (Words{"still", "80.0", "[49.0,", "94.3]", "20.0", "[5.7,", "51.0]"}));
  EXPECT_EQ(wordsOf(goals[2]),
            (Words{"random", "60.0", "[31.3,", "83.2]", "0.0", "[0.0,", "27.8]"}));
  const auto times = linesBehind(text, "mean time to score [s]");
  ASSERT_EQ(times.size(), 3u) << text;
  EXPECT_EQ(wordsOf(times[1]), (Words{"still", "2.50", "2.50"}));
  EXPECT_EQ(wordsOf(times[2]), (Words{"random", "2.50", "-"})) << "shot never scored";
  const auto more = linesBehind(text, "more goals of 100 than against still,");
  ASSERT_EQ(more.size(), 3u) << text;
  EXPECT_EQ(wordsOf(more[1]), (Words{"still", "-", "-"}));
  for (const std::size_t column : {1u, 4u}) EXPECT_EQ(wordsOf(more[2]).at(column), "-20.0") << text;
}

// All pairs have as many episodes, so a player's share is the mean of its row or column.
TEST(MatrixText, RatingsNameAllPlayersWithTheirShareOfGoals) {
  const GoalMatrix matrix = matrixOf({8, 2, 6, 0});
  const auto lines = linesBehind(toText(matrix), "ratings, points of Bradley and Terry");
  ASSERT_EQ(lines.size(), 5u);
  const std::string page = toHtml(matrix, "1");
  std::size_t onPage = page.find("<h2>Ratings</h2>");
  const std::pair<std::string, std::string> expected[] = {
      {"still", "50.0"}, {"random", "30.0"}, {"roll", "70.0"}, {"shot", "10.0"}};
  for (std::size_t i = 0; i < 4; ++i) {
    const auto& [name, share] = expected[i];
    const Words words = wordsOf(lines[i]);
    ASSERT_EQ(words.size(), 7u) << lines[i];
    EXPECT_EQ(words[0], name);
    EXPECT_EQ(words[4], share);
    onPage = page.find("<tr><th>" + name + "</th>", onPage);
    ASSERT_NE(onPage, std::string::npos) << name << " is missing, or not in its order";
    const std::string row = page.substr(onPage, page.find("</tr>", onPage) - onPage);
    EXPECT_NE(row.find(">" + share + "<small>"), std::string::npos) << row;
    EXPECT_NE(row.find("<td>" + words[1] + "<small>"), std::string::npos) << row;
  }
  // Without the yardstick the strikers' mean is 0.
  EXPECT_GT(std::stoi(wordsOf(lines[2])[1]), 0);
  EXPECT_EQ(std::stoi(wordsOf(lines[2])[1]), -std::stoi(wordsOf(lines[3])[1]));
}

// Each striker beats one keeper, and the other one beats it, so that strength says little: the
// likelihood's maximum (by another program's gradient ascent) is 32 goals of 100 wrong about three
// pairs and 33.2 about the fourth.
TEST(MatrixText, ThePairThatRatingsFitWorstIsNamed) {
  const GoalMatrix matrix = matrixOf({8, 2, 2, 9});
  const auto lines = linesBehind(toText(matrix), "ratings, points of Bradley and Terry");
  ASSERT_EQ(lines.size(), 5u);
  EXPECT_EQ(lines[4], "  the ratings fit worst for shot against random, +33.2 goals of 100");
  EXPECT_NE(toHtml(matrix, "1")
                .find("The ratings fit worst for shot against random, with an error "
                      "of +33.2 goals of 100."),
            std::string::npos);
}

// Where there are too few goals, and by symmetry all are as strong as each other: a goal is as
// likely as none.
TEST(MatrixText, TheWorstFitMayBeThatOfMissingGoals) {
  const auto lines =
      linesBehind(toText(matrixOf({1, 9, 9, 1})), "ratings, points of Bradley and Terry");
  ASSERT_EQ(lines.size(), 5u);
  EXPECT_EQ(lines[4], "  the ratings fit worst for roll against still, -40.0 goals of 100");
}

}  // namespace
}  // namespace ortung
