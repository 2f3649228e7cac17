#include <charconv>
#include <limits>
#include <stdexcept>

#include "ResultJson.hpp"
#include "ortung/benchmark/FootballMatrix.hpp"
#include "ortung/benchmark/FootballRatings.hpp"

namespace ortung {
namespace {

constexpr const char* kFormat = "ortung football benchmark 1";

/// A figure that each team has, and its key.
struct TeamFigure {
  const char* key;
  FootballHalf::OfTeams FootballHalf::* figure;
};
constexpr std::array<TeamFigure, 3> kOfTeams = {{{"goals", &FootballHalf::goals},
                                                 {"own_goals", &FootballHalf::ownGoals},
                                                 {"passes", &FootballHalf::passes}}};
struct CountFigure {
  const char* key;
  std::int32_t FootballHalf::* figure;
};
constexpr std::array<CountFigure, 2> kCounts = {
    {{"stuck", &FootballHalf::stuck}, {"late", &FootballHalf::late}}};
struct TimeFigure {
  const char* key;
  Timestamp FootballHalf::* figure;
};
constexpr std::array<TimeFigure, 5> kTimes = {
    {{"in_play_us", &FootballHalf::inPlay},
     {"nobody_goes_for_the_ball_us", &FootballHalf::unattended},
     {"longest_without_anybody_us", &FootballHalf::longestAlone},
     {"longest_stand_of_the_nearest_us", &FootballHalf::longestIdle},
     {"longest_stand_us", &FootballHalf::longestStand}}};

/// Writes a half as an object of its figures.
Json toJson(const FootballHalf& half) {
  Json json;
  for (const TeamFigure& one : kOfTeams) json[one.key] = half.*one.figure;
  for (const CountFigure& one : kCounts) json[one.key] = half.*one.figure;
  for (const TimeFigure& one : kTimes) json[one.key] = half.*one.figure;
  for (const PoseError& error : half.pose) {
    json["pose_errors_um"].push_back(error.position);
    json["pose_errors_urad"].push_back(error.heading);
  }
  json["digest"] = hexadecimal(half.digest, 8);
  return json;
}

/// Reads two whole numbers. @throws std::runtime_error
std::array<std::int32_t, 2> twoOf(const Json& json, const char* key, std::int64_t low) {
  const auto numbers =
      wholeNumbers<std::int32_t>(json.at(key), key, low, std::numeric_limits<std::int32_t>::max());
  if (!json.at(key).is_array() || numbers.size() != 2)
    throw std::runtime_error(std::string(key) + " has " + std::to_string(numbers.size()) +
                             " numbers, expected one for each of two teams");
  return {numbers[0], numbers[1]};
}

/// @throws std::runtime_error, Json::exception
FootballHalf halfIn(const Json& json) {
  FootballHalf half;
  constexpr std::int64_t kMost = std::numeric_limits<std::int32_t>::max();
  constexpr std::int64_t kDay = std::int64_t{24} * 3600 * 1'000'000;
  for (const TeamFigure& one : kOfTeams) half.*one.figure = twoOf(json, one.key, 0);
  for (const CountFigure& one : kCounts)
    half.*one.figure = static_cast<std::int32_t>(whole(json.at(one.key), one.key, 0, kMost));
  for (const TimeFigure& one : kTimes) half.*one.figure = whole(json.at(one.key), one.key, 0, kDay);
  const auto positions = twoOf(json, "pose_errors_um", PoseError::kNone);
  const auto headings = twoOf(json, "pose_errors_urad", PoseError::kNone);
  for (const std::size_t team : {0U, 1U}) half.pose[team] = {positions[team], headings[team]};
  const std::string digest = json.at("digest");
  const auto [end, error] =
      std::from_chars(digest.data(), digest.data() + digest.size(), half.digest, 16);
  if (digest.size() != 8 || error != std::errc() || end != digest.data() + digest.size())
    throw std::runtime_error("a digest can't be read, expected 8 hexadecimal digits");
  return half;
}

Json toJson(const FootballRating& rating) {
  return {{"points", toJson(rating.points)},
          {"won", toJson(rating.won)},
          {"goal_difference", toJson(rating.difference)},
          {"goals", toJson(rating.scored)}};
}

Json ratingsJson(const FootballMatrix& matrix) {
  const auto entrants = matrix.config.entrants();
  Json json = Json::object();
  for (std::size_t league = 0; league < matrix.config.leagues.size(); ++league) {
    const auto ratings = rateFootball(matrix, league);
    for (std::size_t i = 0; i < entrants.size(); ++i)
      json[matrix.config.leagues[league]][entrants[i]] = toJson(ratings[i]);
  }
  return json;
}

/// Reads the halves of a cell. @throws std::runtime_error, Json::exception
void readCell(const Json& json, const FootballConfig& config, FootballCell& cell) {
  const auto entrants = config.entrants();
  const std::string what =
      cell.league + ", '" + entrants[cell.first] + "' against '" + entrants[cell.second] + "': ";
  if (json.at("league") != cell.league || json.at("first") != entrants[cell.first] ||
      json.at("second") != entrants[cell.second])
    throw std::runtime_error(what + "is not in its place");
  const Json& halves = json.at("halves");
  const std::uint64_t n = (config.halves + config.shards - config.shard) / config.shards;
  if (!halves.is_array() || halves.size() != n)
    throw std::runtime_error(what + "has " + std::to_string(halves.size()) + " halves, expected " +
                             std::to_string(n));
  for (const Json& half : halves) cell.halves.push_back(halfIn(half));
  const std::string hash = json.at("hash");
  if (hash != hexadecimal(cell.hash(config), 16))
    throw std::runtime_error(what + "its hash is " + hash + ", but its halves have " +
                             hexadecimal(cell.hash(config), 16));
}

FootballConfig configIn(const Json& json) {
  FootballConfig c;
  if (!json.at("seed").is_number_unsigned())
    throw std::runtime_error("the seed is " + json.at("seed").dump().substr(0, 40) +
                             ", expected a whole number from 0 on");
  c.seed = json.at("seed");
  const auto count = [&](const char* key) {
    return static_cast<std::uint64_t>(
        whole(json.at(key), key, 1, std::numeric_limits<std::int64_t>::max()));
  };
  c.halves = count("halves");
  c.shard = count("shard");
  c.shards = count("shards");
  c.seconds = json.at("half_s").get<double>();
  c.leagues = namesOf(json.at("leagues"));
  c.teams = namesOf(json.at("teams"));
  c.against = namesOf(json.at("against"));
  c.check();
  return c;
}

}  // namespace

bool isFootballJson(std::string_view json) {
  constexpr std::size_t kBegin = 200;  // the format comes first
  return json.substr(0, kBegin).find(kFormat) != json.npos;
}

std::string toJson(const FootballMatrix& matrix, std::string_view version) {
  const FootballConfig& c = matrix.config;
  const auto entrants = c.entrants();
  Json json = {{"format", kFormat},     {"version", version},   {"worlds", matrix.worlds},
               {"seed", c.seed},        {"halves", c.halves},   {"half_s", c.seconds},
               {"shard", c.shard},      {"shards", c.shards},   {"leagues", c.leagues},
               {"teams", c.teams},      {"against", c.against}, {"ratings", ratingsJson(matrix)},
               {"cells", Json::array()}};
  for (const FootballCell& cell : matrix.cells) {
    Json one = {{"league", cell.league},
                {"first", entrants[cell.first]},
                {"second", entrants[cell.second]},
                {"hash", hexadecimal(cell.hash(c), 16)},
                {"halves", Json::array()}};
    for (const FootballHalf& half : cell.halves) one["halves"].push_back(toJson(half));
    json["cells"].push_back(one);
  }
  // Bytes of a command line that are not UTF-8 are replaced, not refused.
  return json.dump(1, ' ', true, Json::error_handler_t::replace) + "\n";
}

namespace {

FootballMatrix matrixIn(const Json& json) {
  FootballMatrix matrix{configIn(json), namesOf(json.at("worlds")), {}};
  const FootballConfig& c = matrix.config;
  if (matrix.worlds.size() != c.leagues.size())
    throw std::runtime_error("expected a world for each league");
  for (const std::string& league : c.leagues)
    for (const auto& [first, second] : c.pairs())
      matrix.cells.push_back({league, first, second, {}});
  const Json& cells = json.at("cells");
  if (!cells.is_array() || cells.size() != matrix.cells.size())
    throw std::runtime_error("expected a cell for each pair and league");
  for (std::size_t i = 0; i < cells.size(); ++i) readCell(cells[i], c, matrix.cells[i]);
  return matrix;
}

}  // namespace

FootballMatrix readFootball(std::string_view text, const std::string& name) {
  return readResult(text, name, kFormat, "`ortung benchmark football`", matrixIn);
}

}  // namespace ortung
