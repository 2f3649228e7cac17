#include <algorithm>
#include <cstdio>

#include "ortung/benchmark/GoalMatrix.hpp"

namespace ortung {
namespace {

/// The policy or kind of our own players, else the whole text.
std::string shortName(const std::string& text) {
  for (const std::string begin : {"goalkeeper:policy=", "striker:kind="})
    if (text.starts_with(begin) && text.find('&') == text.npos) return text.substr(begin.size());
  return text;
}

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

/// A row for each keeper, a column for each striker.
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
    text += table(matrix,
                  "\nmore goals than against " + shortName(c.keepers.front()) +
                      ", of 100 in the same situations [95 %]",
                  [&](std::size_t k, std::size_t s) {
                    return k == 0 ? std::string("-") : percent(matrix.difference(k, 0, s), true);
                  });
  return text;
}

}  // namespace ortung
