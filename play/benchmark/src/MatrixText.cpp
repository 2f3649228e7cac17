#include <algorithm>
#include <cstdio>

#include "ortung/benchmark/GoalMatrix.hpp"
#include "ortung/benchmark/Ratings.hpp"

namespace ortung {
namespace {

std::string percent(const Interval& share, bool isSigned) {
  char text[64];
  std::snprintf(text, sizeof text, isSigned ? "%+.1f [%+.1f, %+.1f]" : "%.1f [%.1f, %.1f]",
                100.0 * share.value, 100.0 * share.low, 100.0 * share.high);
  return text;
}

std::string padded(std::string text, std::size_t width) {
  if (text.size() < width) text.append(width - text.size(), ' ');
  return text + "  ";
}

/// Writes a table with a row for each keeper and a column for each striker.
template <class Entry>
std::string table(const GoalMatrix& matrix, const std::string& title, const Entry& entry) {
  std::vector<std::vector<std::string>> rows(1);
  rows[0].push_back("keeper");
  for (const std::string& striker : matrix.config.strikers) rows[0].push_back(shortName(striker));
  for (std::size_t k = 0; k < matrix.config.keepers.size(); ++k) {
    rows.emplace_back().push_back(shortName(matrix.config.keepers[k]));
    for (std::size_t s = 0; s < matrix.config.strikers.size(); ++s)
      rows.back().push_back(entry(k, s));
  }
  std::string text = title + "\n";
  for (const auto& row : rows) {
    std::string line = "  ";
    for (std::size_t column = 0; column < row.size(); ++column) {
      std::size_t width = 0;
      for (const auto& other : rows) width = std::max(width, other[column].size());
      line += padded(row[column], width);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

std::string errors(const std::optional<ErrorSummary>& error) {
  if (!error) return "-";
  constexpr double kDegrees = 57.29577951308232;
  char text[80];
  std::snprintf(text, sizeof text, "%.3f / %.3f, %.2f / %.2f", error->mean, error->median,
                kDegrees * error->meanHeading, kDegrees * error->medianHeading);
  return text;
}

/// Returns the name of the keeper with which others are compared.
std::string baseline(const GoalMatrix& matrix) {
  for (std::size_t k = 1; k < matrix.config.keepers.size(); ++k)
    if (matrix.baselineOf(k) != 0)
      return "the same keeper with its first option sees, or the first keeper";
  return shortName(matrix.config.keepers.front());
}

bool hasErrors(const GoalMatrix& matrix, bool ofKeepers) {
  return std::any_of(matrix.cells.begin(), matrix.cells.end(), [&](const GoalCell& cell) {
    const auto error = ofKeepers ? cell.keeperError() : cell.strikerError();
    return error && error->mean > 0.0;
  });
}

std::string ratingLines(const GoalMatrix& matrix) {
  const GoalRatings ratings = rate(matrix);
  std::string text =
      "\nratings, points of Bradley and Terry [95 %], and goals of 100 episodes on average\n";
  const auto add = [&](const std::string& name, const Rating& rating) {
    char points[80];
    std::snprintf(points, sizeof points, "%+.0f [%+.0f, %+.0f]", rating.points.value,
                  rating.points.low, rating.points.high);
    text += "  " + padded(shortName(name), 24) + padded(points, 24) +
            percent(rating.scoring, false) + "\n";
  };
  for (std::size_t k = 0; k < ratings.keepers.size(); ++k)
    add(matrix.config.keepers[k], ratings.keepers[k]);
  for (std::size_t s = 0; s < ratings.strikers.size(); ++s)
    add(matrix.config.strikers[s], ratings.strikers[s]);
  char miss[32];
  std::snprintf(miss, sizeof miss, "%+.1f", 100.0 * ratings.worstMiss);
  return text + "  the ratings fit worst for " +
         shortName(matrix.config.strikers[ratings.worstStriker]) + " against " +
         shortName(matrix.config.keepers[ratings.worstKeeper]) + ", " + miss + " goals of 100\n";
}

}  // namespace

std::string toText(const GoalMatrix& matrix) {
  const GoalMatrixConfig& c = matrix.config;
  std::string text =
      std::to_string(c.episodes) + " episodes a pair, seed " + std::to_string(c.seed);
  if (c.shards > 1) text += ", shard " + std::to_string(c.shard) + "/" + std::to_string(c.shards);
  text += "\n\n";
  text += table(matrix, "goals of 100 episodes [95 %]", [&](std::size_t k, std::size_t s) {
    return percent(matrix.cell(k, s).scoring(), false);
  });
  text += table(matrix, "\nmean time to score [s]", [&](std::size_t k, std::size_t s) {
    const auto time = matrix.cell(k, s).meanTimeToScore();
    char figure[32];
    std::snprintf(figure, sizeof figure, "%.2f", time.value_or(0.0));
    return time ? std::string(figure) : std::string("-");
  });
  if (c.keepers.size() > 1)
    text += table(
        matrix,
        "\nmore goals of 100 than against " + baseline(matrix) + ", in the same situations [95 %]",
        [&](std::size_t k, std::size_t s) {
          const std::size_t base = matrix.baselineOf(k);
          return k == base ? std::string("-") : percent(matrix.difference(k, base, s), true);
        });
  for (const bool ofKeepers : {true, false})
    if (hasErrors(matrix, ofKeepers))
      text += table(matrix,
                    std::string("\npose error of the ") + (ofKeepers ? "keeper" : "striker") +
                        ": mean / median [m], [deg]",
                    [&](std::size_t k, std::size_t s) {
                      const GoalCell& cell = matrix.cell(k, s);
                      return errors(ofKeepers ? cell.keeperError() : cell.strikerError());
                    });
  return text + ratingLines(matrix);
}

}  // namespace ortung
