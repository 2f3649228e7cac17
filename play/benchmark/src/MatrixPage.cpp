#include "ortung/benchmark/MatrixPage.hpp"

#include <algorithm>
#include <cstdio>

#include "EpisodePicture.hpp"
#include "ortung/benchmark/Ratings.hpp"

namespace ortung {
namespace {

constexpr const char* kStyle = R"(
:root { color-scheme: light dark; --ink: #1c2733; --paper: #fbfbf9; --rule: #c9ced6; --grass: #e6efe2;
  --line: #9fb39a; --ball: #d9570c; --keeper: #1d5fb8; --striker: #a3850a; --soft: #5b6775; --heat: 210, 84, 30; }
@media (prefers-color-scheme: dark) { :root { --ink: #e4e8ee; --paper: #14181e; --rule: #3a434f; --grass: #1d2a20;
  --line: #52664f; --ball: #ff8a42; --keeper: #6ea8f5; --striker: #e3c34a; --soft: #98a3b1; --heat: 255, 138, 66; } }
body { font: 15px/1.45 system-ui, sans-serif; color: var(--ink); background: var(--paper); margin: 2em auto;
  max-width: 76em; padding: 0 1em; }
h1 { font-size: 1.5em; margin-bottom: 0.2em; } h2 { font-size: 1.1em; margin: 2em 0 0.5em; }
p { max-width: 50em; color: var(--soft); }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; }
th, td { padding: 0.35em 0.8em; border-bottom: 1px solid var(--rule); text-align: right; white-space: nowrap; }
th:first-child { text-align: left; font-weight: 600; }
td small { display: block; color: var(--soft); }
td.share { background: rgba(var(--heat), var(--share)); }
td.share small { color: var(--ink); opacity: 0.75; }
.episodes { display: grid; grid-template-columns: repeat(auto-fill, minmax(15em, 1fr)); gap: 1em; }
figure { margin: 0; } figcaption { color: var(--soft); font-size: 0.9em; }
svg { background: var(--grass); border-radius: 4px; width: 100%; display: block; }
svg .line, svg .goal { fill: none; stroke: var(--line); stroke-width: 0.05; }
svg .goal { stroke-width: 0.1; }
svg polyline { fill: none; stroke-width: 0.05; }
svg polyline.ball { stroke: var(--ball); } svg polyline.keeper { stroke: var(--keeper); }
svg polyline.striker { stroke: var(--striker); stroke-dasharray: 0.12 0.08; }
svg .body.ball { fill: var(--ball); } svg .body.keeper { fill: var(--keeper); } svg .body.striker { fill: var(--striker); }
svg .from { fill: none; stroke-width: 0.03; } svg .from.ball { stroke: var(--ball); } svg .from.keeper { stroke: var(--keeper); }
)";

std::string escaped(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '&')
      safe += "&amp;";
    else if (c == '<')
      safe += "&lt;";
    else if (c == '>')
      safe += "&gt;";
    else if (c == '"')
      safe += "&quot;";
    else if (static_cast<unsigned char>(c) < ' ')
      safe += ' ';
    else
      safe += c;
  }
  return safe;
}

std::string format(const char* form, double a, double b = 0.0, double c = 0.0) {
  char text[128];
  std::snprintf(text, sizeof text, form, a, b, c);
  return text;
}

std::string share(const Interval& i) {
  return format("<td class=\"share\" style=\"--share:%.2f\">", 0.75 * i.value) +
         format("%.1f<small>%.1f to %.1f</small></td>", 100.0 * i.value, 100.0 * i.low,
                100.0 * i.high);
}
std::string difference(const Interval& i) {
  return format("<td>%+.1f<small>%+.1f to %+.1f</small></td>", 100.0 * i.value, 100.0 * i.low,
                100.0 * i.high);
}
std::string error(const std::optional<ErrorSummary>& e) {
  if (!e) return "<td>–</td>";
  return format("<td>%.3f / %.3f<small>%.2f°", e->mean, e->median,
                57.29577951308232 * e->meanHeading) +
         " on average</small></td>";
}

/// Writes a table with a row for each keeper and a column for each striker.
template <class Entry>
std::string table(const GoalMatrix& matrix, const char* title, const char* about,
                  const Entry& entry) {
  std::string html = std::string("<h2>") + title + "</h2><p>" + about +
                     "</p><div class=\"wide\"><table><tr><th>keeper</th>";
  for (const std::string& striker : matrix.config.strikers)
    html += "<th>" + escaped(shortName(striker)) + "</th>";
  html += "</tr>";
  for (std::size_t k = 0; k < matrix.config.keepers.size(); ++k) {
    html += "<tr><th>" + escaped(shortName(matrix.config.keepers[k])) + "</th>";
    for (std::size_t s = 0; s < matrix.config.strikers.size(); ++s) html += entry(k, s);
    html += "</tr>";
  }
  return html + "</table></div>";
}

std::string ratings(const GoalMatrix& matrix) {
  const GoalRatings found = rate(matrix);
  std::string html =
      "<h2>Ratings</h2><p>Points of Bradley and Terry: the odds of a goal are 10 to the power of "
      "(striker - keeper) / 400. If yardstick-v1 plays, it has 0 points. Mean: goals of 100 "
      "episodes "
      "over all opponents.</p><div class=\"wide\"><table><tr><th>player</th><th>points</th>"
      "<th>mean</th></tr>";
  const auto add = [&](const std::string& name, const Rating& rating) {
    html += "<tr><th>" + escaped(shortName(name)) + "</th>" +
            format("<td>%+.0f<small>%+.0f to %+.0f</small></td>", rating.points.value,
                   rating.points.low, rating.points.high) +
            share(rating.scoring) + "</tr>";
  };
  for (std::size_t k = 0; k < found.keepers.size(); ++k)
    add(matrix.config.keepers[k], found.keepers[k]);
  for (std::size_t s = 0; s < found.strikers.size(); ++s)
    add(matrix.config.strikers[s], found.strikers[s]);
  return html + "</table></div><p>The ratings fit worst for " +
         escaped(shortName(matrix.config.strikers[found.worstStriker])) + " against " +
         escaped(shortName(matrix.config.keepers[found.worstKeeper])) +
         format(", with an error of %+.1f goals of 100.</p>", 100.0 * found.worstMiss);
}

/// Draws the first episode of a pair with each outcome that occurs.
std::string episodesOf(const GoalMatrix& matrix, const GoalCell& cell, GoalEpisodes& episodes) {
  std::string html;
  const GoalMatrixConfig& c = matrix.config;
  for (const GoalOutcome outcome : {GoalOutcome::kGoal, GoalOutcome::kSaved, GoalOutcome::kOut}) {
    const auto one = std::find_if(cell.episodes.begin(), cell.episodes.end(),
                                  [&](const GoalEpisode& e) { return e.outcome == outcome; });
    if (one == cell.episodes.end()) continue;
    const auto place = static_cast<std::uint64_t>(one - cell.episodes.begin());
    const std::uint64_t number = c.shard - 1 + place * c.shards;
    std::vector<GoalMoment> moments;
    episodes.play(cell.keeper, cell.striker, c.seed, number,
                  [&](const GoalMoment& moment) { moments.push_back(moment); });
    const std::string what =
        escaped(shortName(cell.striker) + " against " + shortName(cell.keeper));
    const std::string how = std::string(nameOf(outcome)) +
                            format(" after %.2f s", toSeconds(one->end)) + ", episode " +
                            std::to_string(number);
    html += "<figure>" + pictureOf(moments, what + ": " + how) + "<figcaption>" + what + "<br>" +
            how + "</figcaption></figure>\n";
  }
  return html;
}

bool hasErrors(const GoalMatrix& matrix) {
  return std::any_of(matrix.cells.begin(), matrix.cells.end(), [](const GoalCell& cell) {
    const auto error = cell.keeperError();
    return error && error->mean > 0.0;
  });
}

}  // namespace

std::string toHtml(const GoalMatrix& matrix, std::string_view version) {
  const GoalMatrixConfig& c = matrix.config;
  std::string html =
      "<!doctype html>\n<html lang=\"en\"><meta charset=\"utf-8\">"
      "<meta name=\"viewport\" content=\"width=device-width\">"
      "<title>Goalkeeper benchmark</title><style>" +
      std::string(kStyle) + "</style>\n<h1>Goalkeeper benchmark</h1><p>" +
      std::to_string(c.episodes) + " episodes a pair, seed " + std::to_string(c.seed) +
      (c.shards > 1 ? ", shard " + std::to_string(c.shard) + " of " + std::to_string(c.shards)
                    : std::string()) +
      ", Ortung " + escaped(std::string(version)) + ", world " + escaped(matrix.world) +
      ". Small figures are intervals of 95 %.</p>\n";
  html += table(matrix, "Goals of 100 episodes", "Intervals are Wilson's.",
                [&](std::size_t k, std::size_t s) { return share(matrix.cell(k, s).scoring()); });
  if (c.keepers.size() > 1)
    html += table(matrix, "More goals than in the same situations against another keeper",
                  "Compared with the same keeper with its first option sees, otherwise with the "
                  "first keeper; intervals by bootstrap over the pairs.",
                  [&](std::size_t k, std::size_t s) {
                    const std::size_t base = matrix.baselineOf(k);
                    return k == base ? std::string("<td>–</td>")
                                     : difference(matrix.difference(k, base, s));
                  });
  if (hasErrors(matrix))
    html +=
        table(matrix, "Pose error of the keeper", "Mean and median over episodes [m].",
              [&](std::size_t k, std::size_t s) { return error(matrix.cell(k, s).keeperError()); });
  html += ratings(matrix);
  html +=
      "<h2>Episodes</h2><p>The first one of each outcome, seen from above with the goal at the "
      "bottom. Hollow shapes: start of ball and keeper.</p><div class=\"episodes\">\n";
  GoalEpisodes episodes;
  for (const GoalCell& cell : matrix.cells) html += episodesOf(matrix, cell, episodes);
  return html + "</div></html>\n";
}

}  // namespace ortung
