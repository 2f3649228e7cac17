#include <algorithm>
#include <charconv>
#include <limits>
#include <stdexcept>

#include "ResultJson.hpp"
#include "ortung/benchmark/GoalMatrix.hpp"
#include "ortung/benchmark/Ratings.hpp"

namespace ortung {
namespace {

constexpr const char* kFormat = "ortung goalkeeper benchmark 1";
constexpr std::string_view kLetters = "gsot";  ///< letters of the outcomes, in their order

Json toJson(const ErrorSummary& error) {
  return {{"episodes", error.episodes},
          {"mean_m", error.mean},
          {"median_m", error.median},
          {"mean_heading_rad", error.meanHeading},
          {"median_heading_rad", error.medianHeading}};
}

/// Adds the pose errors of one of the two players if it has reported its pose.
void addErrors(Json& json, const std::string& who, const std::optional<ErrorSummary>& summary,
               const std::vector<GoalEpisode>& episodes, PoseError GoalEpisode::* whose) {
  if (!summary) return;
  json[who + "_pose_error"] = toJson(*summary);
  Json positions = Json::array();
  Json headings = Json::array();
  for (const GoalEpisode& episode : episodes) {
    positions.push_back((episode.*whose).position);
    headings.push_back((episode.*whose).heading);
  }
  json[who + "_errors_um"] = positions;
  json[who + "_errors_urad"] = headings;
}

/// Reads the pose errors of one of the two players. @throws std::runtime_error
void readErrors(const Json& json, const std::string& who, std::vector<GoalEpisode>& episodes,
                PoseError GoalEpisode::* whose) {
  if (!json.contains(who + "_errors_um")) return;
  constexpr std::int64_t kMost = std::numeric_limits<std::int32_t>::max();
  const std::string what = "an error of the " + who;
  const auto positions = wholeNumbers<std::int32_t>(json.at(who + "_errors_um"), what, -1, kMost);
  const auto headings = wholeNumbers<std::int32_t>(json.at(who + "_errors_urad"), what, -1, kMost);
  if (positions.size() != episodes.size() || headings.size() != episodes.size())
    throw std::runtime_error(who + "_errors: there are " + std::to_string(positions.size()) +
                             " and " + std::to_string(headings.size()) + ", expected " +
                             std::to_string(episodes.size()));
  for (std::size_t i = 0; i < episodes.size(); ++i)
    episodes[i].*whose = {positions[i], headings[i]};
}

Json toJson(const Rating& rating) {
  return {{"points", toJson(rating.points)}, {"mean_scoring", toJson(rating.scoring)}};
}

Json ratingsJson(const GoalMatrix& matrix) {
  const GoalRatings ratings = rate(matrix);
  Json json;
  for (std::size_t k = 0; k < ratings.keepers.size(); ++k)
    json["keepers"][matrix.config.keepers[k]] = toJson(ratings.keepers[k]);
  for (std::size_t s = 0; s < ratings.strikers.size(); ++s)
    json["strikers"][matrix.config.strikers[s]] = toJson(ratings.strikers[s]);
  json["worst_miss"] = {{"keeper", matrix.config.keepers[ratings.worstKeeper]},
                        {"striker", matrix.config.strikers[ratings.worstStriker]},
                        {"share", ratings.worstMiss}};
  return json;
}

Json cellJson(const GoalMatrix& matrix, std::size_t k, std::size_t s) {
  const GoalCell& cell = matrix.cell(k, s);
  Json json = {{"keeper", cell.keeper}, {"striker", cell.striker}};
  for (const GoalOutcome outcome :
       {GoalOutcome::kGoal, GoalOutcome::kSaved, GoalOutcome::kOut, GoalOutcome::kTime})
    json["count"][std::string(nameOf(outcome))] = cell.count(outcome);
  json["scoring"] = toJson(cell.scoring());
  const auto time = cell.meanTimeToScore();
  json["time_to_score_s"] = time ? Json(*time) : Json(nullptr);
  if (const std::size_t base = matrix.baselineOf(k); base != k) {
    json["compared_with"] = matrix.config.keepers[base];
    json["more_than_that"] = toJson(matrix.difference(k, base, s));
  }
  json["hash"] = hexadecimal(cell.hash(matrix.config), 16);
  std::string outcomes;
  std::string digests;
  Json ends = Json::array();
  for (const GoalEpisode& episode : cell.episodes) {
    outcomes += kLetters[static_cast<std::size_t>(episode.outcome)];
    digests += hexadecimal(episode.digest, 8);
    ends.push_back(episode.end);
  }
  json["outcomes"] = outcomes;
  json["digests"] = digests;
  json["ends_us"] = ends;
  addErrors(json, "keeper", cell.keeperError(), cell.episodes, &GoalEpisode::keeper);
  addErrors(json, "striker", cell.strikerError(), cell.episodes, &GoalEpisode::striker);
  return json;
}

/// Reads a cell. @throws std::runtime_error
GoalCell readCell(const Json& json, const GoalMatrixConfig& config) {
  GoalCell cell{json.at("keeper"), json.at("striker"), {}};
  const std::string what = "'" + cell.striker + "' against '" + cell.keeper + "': ";
  const std::string outcomes = json.at("outcomes");
  const std::string digests = json.at("digests");
  constexpr std::int64_t kDay = std::int64_t{24} * 3600 * 1'000'000;
  const auto ends = wholeNumbers<Timestamp>(json.at("ends_us"), what + "an end", 0, kDay);
  const std::uint64_t n = (config.episodes + config.shards - config.shard) / config.shards;
  if (outcomes.size() != n || digests.size() != 8 * n || ends.size() != n)
    throw std::runtime_error(what + "has " + std::to_string(outcomes.size()) + " outcomes, " +
                             std::to_string(digests.size()) + " digits of digests and " +
                             std::to_string(ends.size()) + " ends, expected those of " +
                             std::to_string(n) + " episodes");
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t outcome = kLetters.find(outcomes[i]);
    GoalEpisode episode;
    const char* digits = digests.data() + 8 * i;
    const auto [end, error] = std::from_chars(digits, digits + 8, episode.digest, 16);
    if (outcome == kLetters.npos || error != std::errc() || end != digits + 8)
      throw std::runtime_error(what + "episode " + std::to_string(i) +
                               " of the file has outcome '" + outcomes[i] +
                               "' and a digest that can't be read, expected one of 'gsot' and 8 "
                               "hexadecimal digits");
    episode.outcome = static_cast<GoalOutcome>(outcome);
    episode.end = ends[i];
    cell.episodes.push_back(episode);
  }
  readErrors(json, "keeper", cell.episodes, &GoalEpisode::keeper);
  readErrors(json, "striker", cell.episodes, &GoalEpisode::striker);
  const std::string hash = json.at("hash");
  if (hash != hexadecimal(cell.hash(config), 16))
    throw std::runtime_error(what + "its hash is " + hash + ", but its episodes have " +
                             hexadecimal(cell.hash(config), 16));
  return cell;
}

}  // namespace

std::string toJson(const GoalMatrix& matrix, std::string_view version) {
  const GoalMatrixConfig& c = matrix.config;
  Json json = {{"format", kFormat},      {"version", version},
               {"world", matrix.world},  {"seed", c.seed},
               {"episodes", c.episodes}, {"shard", c.shard},
               {"shards", c.shards},     {"keepers", c.keepers},
               {"strikers", c.strikers}, {"ratings", ratingsJson(matrix)},
               {"cells", Json::array()}};
  for (std::size_t k = 0; k < c.keepers.size(); ++k)
    for (std::size_t s = 0; s < c.strikers.size(); ++s)
      json["cells"].push_back(cellJson(matrix, k, s));
  // Bytes of a command line that are not UTF-8 are replaced, not refused.
  return json.dump(1, ' ', true, Json::error_handler_t::replace) + "\n";
}

namespace {

GoalMatrix matrixIn(const Json& json) {
  GoalMatrix matrix;
  GoalMatrixConfig& c = matrix.config;
  matrix.world = json.at("world");
  if (!json.at("seed").is_number_unsigned())
    throw std::runtime_error("the seed is " + json.at("seed").dump().substr(0, 40) +
                             ", expected a whole number from 0 on");
  c.seed = json.at("seed");
  constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
  const auto count = [&](const char* key) {
    return static_cast<std::uint64_t>(whole(json.at(key), key, 1, kMost));
  };
  c.episodes = count("episodes");
  c.shard = count("shard");
  c.shards = count("shards");
  c.keepers = namesOf(json.at("keepers"));
  c.strikers = namesOf(json.at("strikers"));
  c.check();
  const Json& cells = json.at("cells");
  if (!cells.is_array() || cells.size() != c.keepers.size() * c.strikers.size())
    throw std::runtime_error("expected a cell for each keeper and striker");
  for (std::size_t i = 0; i < cells.size(); ++i) {
    matrix.cells.push_back(readCell(cells[i], c));
    if (matrix.cells[i].keeper != c.keepers[i / c.strikers.size()] ||
        matrix.cells[i].striker != c.strikers[i % c.strikers.size()])
      throw std::runtime_error("cell " + std::to_string(i) + " is not in its place");
  }
  return matrix;
}

}  // namespace

GoalMatrix readGoalMatrix(std::string_view text, const std::string& name) {
  return readResult(text, name, kFormat, "`ortung benchmark goalkeeper`", matrixIn);
}

}  // namespace ortung
