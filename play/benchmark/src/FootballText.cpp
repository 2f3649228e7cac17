#include <algorithm>
#include <cstdio>

#include "ortung/benchmark/FootballMatrix.hpp"
#include "ortung/benchmark/FootballRatings.hpp"

namespace ortung {
namespace {

std::string number(const char* format, double value) {
  char text[48];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string withInterval(const Interval& one, const char* format, double factor = 1.0) {
  return number(format, factor * one.value) + " [" + number(format, factor * one.low) + ", " +
         number(format, factor * one.high) + "]";
}

std::string line(const std::string& what, const std::string& figure) {
  std::string padded = "  " + what;
  padded.resize(std::max<std::size_t>(padded.size() + 2, 44), ' ');
  return padded + figure + "\n";
}

double seconds(Timestamp time) { return toSeconds(time); }

/// Returns a mean over halves, a sum of both teams.
std::string both(const FootballCell& cell, std::uint64_t seed,
                 FootballHalf::OfTeams FootballHalf::* f) {
  const auto sum = [f](const FootballHalf& half) { return double((half.*f)[0]) + (half.*f)[1]; };
  double total = 0.0;
  for (const FootballHalf& half : cell.halves) total += sum(half);
  return withInterval(cell.mean(sum, seed), "%.2f") + "  (" + number("%.0f", total) + " in all)";
}

std::string count(const FootballCell& cell, std::int32_t FootballHalf::* f) {
  double total = 0.0;
  for (const FootballHalf& half : cell.halves) total += half.*f;
  return number("%.2f", total / static_cast<double>(cell.halves.size())) + "  (" +
         number("%.0f", total) + " in all)";
}

/// Returns the longest of all halves, with the number of that half.
std::string longest(const FootballConfig& c, const FootballCell& cell,
                    Timestamp FootballHalf::* f) {
  const auto most = std::max_element(cell.halves.begin(), cell.halves.end(),
                                     [f](const auto& a, const auto& b) { return a.*f < b.*f; });
  double sum = 0.0;
  for (const FootballHalf& half : cell.halves) sum += seconds(half.*f);
  const auto place = static_cast<std::uint64_t>(most - cell.halves.begin());
  return number("%.1f", seconds((*most).*f)) + " (half " +
         std::to_string(c.shard - 1 + place * c.shards) + "), mean of halves " +
         number("%.1f", sum / static_cast<double>(cell.halves.size()));
}

std::string share(const FootballCell& cell, Timestamp FootballHalf::* part) {
  double sum = 0.0;
  double all = 0.0;
  for (const FootballHalf& half : cell.halves) {
    sum += seconds(half.*part);
    all += seconds(half.inPlay);
  }
  return number("%.2f %%", all > 0.0 ? 100.0 * sum / all : 0.0);
}

std::string poseError(const FootballCell& cell, std::size_t team) {
  double sum = 0.0;
  double heading = 0.0;
  double n = 0.0;
  for (const FootballHalf& half : cell.halves) {
    if (half.pose[team].position == PoseError::kNone) continue;
    sum += 1e-6 * half.pose[team].position;
    heading += 1e-6 * half.pose[team].heading;
    n += 1.0;
  }
  constexpr double kDegrees = 57.29577951308232;
  return n == 0.0 ? "-" : number("%.3f m, ", sum / n) + number("%.2f deg", kDegrees * heading / n);
}

std::string cellText(const FootballMatrix& matrix, const FootballCell& cell) {
  const FootballConfig& c = matrix.config;
  const auto entrants = c.entrants();
  std::string text = "\n" + cell.league + ": " + entrants[cell.first] + " against " +
                     entrants[cell.second] + ", of a half [95 %]\n";
  const auto goals = [&](std::size_t team) {
    return withInterval(
        cell.mean([team](const FootballHalf& half) { return double(half.goals[team]); }, c.seed),
        "%.2f");
  };
  text += line("goals", both(cell, c.seed, &FootballHalf::goals));
  if (cell.first != cell.second)
    text += line("goals of the first, of the second", goals(0) + ", " + goals(1));
  text += line("own goals", both(cell, c.seed, &FootballHalf::ownGoals));
  text += line("passes", both(cell, c.seed, &FootballHalf::passes));
  text += line("ball stuck", count(cell, &FootballHalf::stuck));
  text += line("restarts not taken in time", count(cell, &FootballHalf::late));
  double inPlay = 0.0;
  for (const FootballHalf& half : cell.halves) inPlay += seconds(half.inPlay);
  text += line("ball in play [s]", number("%.0f", inPlay / double(cell.halves.size())));
  text += line("nobody goes for the ball", share(cell, &FootballHalf::unattended));
  text += line("... for at most [s]", longest(c, cell, &FootballHalf::longestAlone));
  text += line("the nearest of a team stands, at most [s]",
               longest(c, cell, &FootballHalf::longestIdle));
  text +=
      line("any field player stands, at most [s]", longest(c, cell, &FootballHalf::longestStand));
  const auto errs = [](const FootballHalf& half) {
    return half.pose[0].position > 0 || half.pose[1].position > 0;
  };
  if (std::any_of(cell.halves.begin(), cell.halves.end(), errs))
    text += line("pose error, of the first, of the second",
                 poseError(cell, 0) + "; " + poseError(cell, 1));
  return text;
}

std::string ratingText(const FootballMatrix& matrix, std::size_t league) {
  const auto entrants = matrix.config.entrants();
  const auto ratings = rateFootball(matrix, league);
  std::string text = "\n" + matrix.config.leagues[league] +
                     ": ratings [95 %], halves won of 100, goal difference and goals of a half\n";
  for (std::size_t i = 0; i < entrants.size(); ++i)
    text += line(entrants[i], withInterval(ratings[i].points, "%+.0f") + "  " +
                                  withInterval(ratings[i].won, "%.0f", 100.0) + "  " +
                                  withInterval(ratings[i].difference, "%+.2f") + "  " +
                                  withInterval(ratings[i].scored, "%.2f"));
  return text;
}

/// Compares all teams with the first one, against the same opponent from the same seeds.
std::string comparisonText(const FootballMatrix& matrix, std::size_t league) {
  const FootballConfig& c = matrix.config;
  const auto entrants = c.entrants();
  const std::size_t opponents = c.against.size();
  const std::size_t begin = league * c.pairs().size();
  std::string text = "\n" + c.leagues[league] + ": goal difference of a half more than " +
                     c.teams.front() + ", from the same seeds [95 %]\n";
  for (std::size_t t = 1; t < c.teams.size(); ++t)
    for (std::size_t o = 0; o < opponents; ++o)
      text += line(c.teams[t] + " against " + c.against[o],
                   withInterval(differenceOf(matrix, matrix.cells[begin + t * opponents + o],
                                             matrix.cells[begin + o]),
                                "%+.2f"));
  return text;
}

}  // namespace

std::string toText(const FootballMatrix& matrix) {
  const FootballConfig& c = matrix.config;
  std::string text = std::to_string(c.halves) + " halves a pair, seed " + std::to_string(c.seed);
  if (c.seconds > 0.0) text += ", of " + number("%.0f", c.seconds) + " s";
  if (c.shards > 1) text += ", shard " + std::to_string(c.shard) + "/" + std::to_string(c.shards);
  text += "\n";
  for (const FootballCell& cell : matrix.cells) text += cellText(matrix, cell);
  for (std::size_t league = 0; league < c.leagues.size(); ++league) {
    if (c.entrants().size() > 1) text += ratingText(matrix, league);
    if (!c.against.empty() && c.teams.size() > 1) text += comparisonText(matrix, league);
  }
  return text;
}

}  // namespace ortung
