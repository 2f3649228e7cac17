// What `ortung benchmark` prints of a matrix.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "DrawnMatrix.hpp"
#include "ortung/benchmark/Ratings.hpp"

namespace ortung {
namespace {

using test::drawn;

/// The lines behind the one that begins so, up to an empty one.
std::vector<std::string> linesBehind(const std::string& text, const std::string& title) {
  std::istringstream in(text);
  std::vector<std::string> lines;
  std::string line;
  while (std::getline(in, line) && !line.starts_with(title)) {
  }
  while (std::getline(in, line) && !line.empty()) lines.push_back(line);
  return lines;
}

TEST(MatrixText, RatesEachPlayerOnALineOfItsOwn) {
  const GoalMatrix matrix = drawn({{0.9, 0.5}, {0.3, 0.2}, {0.6, 0.4}}, 400, {"a", "b"});
  const std::vector<std::string> lines = linesBehind(toText(matrix), "ratings, points");
  ASSERT_EQ(lines.size(), 6u) << "three keepers, two strikers, and where they fit worst";
  const GoalRatings ratings = rate(matrix);
  const auto goals = [&](std::size_t k, std::size_t s) {
    return 100.0 * matrix.cell(k, s).scoring().value;
  };
  for (std::size_t i = 0; i < 5; ++i) {
    const bool isKeeper = i < 3;
    const std::size_t at = isKeeper ? i : i - 3;
    std::istringstream words(lines[i]);
    std::string name, interval;
    double points = 0.0, low = 0.0, high = 0.0, share = 0.0;
    char mark = ' ';
    words >> name >> points >> mark >> low >> mark >> high >> mark >> share;
    EXPECT_EQ(name, isKeeper ? matrix.config.keepers[at] : matrix.config.strikers[at]);
    const Rating& rating = isKeeper ? ratings.keepers[at] : ratings.strikers[at];
    EXPECT_NEAR(points, rating.points.value, 0.5) << lines[i];
    EXPECT_NEAR(low, rating.points.low, 0.5) << lines[i];
    EXPECT_NEAR(high, rating.points.high, 0.5) << lines[i];
    const double mean = isKeeper ? (goals(at, 0) + goals(at, 1)) / 2
                                 : (goals(0, at) + goals(1, at) + goals(2, at)) / 3;
    EXPECT_NEAR(share, mean, 0.06) << lines[i];
  }
}

// Who always scores against one keeper and never against the other is as good as both: half of 100
// are expected.
TEST(MatrixText, SaysWhereTheRatingsFitWorstAndByHowManyGoals) {
  const auto worst = [](const std::vector<std::vector<double>>& shares) {
    return linesBehind(toText(drawn(shares, 100, {"a", "b"})), "ratings, points").back();
  };
  EXPECT_EQ(worst({{1.0, 0.0}, {0.0, 1.0}}),
            "  the ratings fit worst for a against keeper0, +50.0 goals of 100");
  EXPECT_EQ(worst({{0.0, 1.0}, {1.0, 0.0}}),
            "  the ratings fit worst for a against keeper0, -50.0 goals of 100");
}

TEST(MatrixText, HasARowForEachKeeperAndAColumnForEachStriker) {
  const GoalMatrix matrix = drawn({{1.0, 0.0}, {0.0, 1.0}}, 100, {"first", "second"});
  const std::vector<std::string> lines = linesBehind(toText(matrix), "goals of 100 episodes");
  ASSERT_EQ(lines.size(), 3u);
  const std::size_t first = lines[0].find("first");
  const std::size_t second = lines[0].find("second");
  ASSERT_NE(first, std::string::npos);
  ASSERT_NE(second, std::string::npos);
  for (std::size_t k = 0; k < 2; ++k) {
    const std::string& line = lines[k + 1];
    EXPECT_TRUE(line.starts_with("  keeper" + std::to_string(k) + "  ")) << line;
    EXPECT_TRUE(line.substr(k == 0 ? first : second).starts_with("100.0 [")) << line;
    EXPECT_TRUE(line.substr(k == 0 ? second : first).starts_with("0.0 [")) << line;
  }
}

}  // namespace
}  // namespace ortung
