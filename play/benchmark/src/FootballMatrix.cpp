#include "ortung/benchmark/FootballMatrix.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "Jobs.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/benchmark/GoalMatrix.hpp"
#include "ortung/benchmark/Rates.hpp"

namespace ortung {
namespace {

constexpr std::uint64_t kMostHalves = 1'000'000;
constexpr double kLongest = 7200.0;  ///< greatest length of a half [s]
constexpr std::size_t kResamples = 1000;

/// One half to be played.
struct Job {
  FootballHalves::Order order;
  FootballHalf* result = nullptr;
};

void play(const std::vector<Job>& jobs, const FootballRun& run) {
  const FootballTables tables = footballTables();
  doJobs(jobs.size(), run.threads, run.goesOn, [&] {
    return [&jobs, halves = std::make_unique<FootballHalves>(tables)](std::size_t i) {
      *jobs[i].result = halves->play(jobs[i].order);
    };
  });
}

std::uint64_t ownHalves(const FootballConfig& c) {
  return (c.halves + c.shards - c.shard) / c.shards;
}
std::uint64_t numberOf(const FootballConfig& c, std::size_t place) {
  return c.shard - 1 + place * c.shards;
}

FootballHalves::Order orderOf(const FootballConfig& c, const FootballCell& cell,
                              std::uint64_t number) {
  const auto entrants = c.entrants();
  return {cell.league, entrants[cell.first], entrants[cell.second], c.seconds, c.seed, number};
}

void checkNames(const std::vector<std::string>& names, const char* what) {
  std::set<std::string> known;
  for (const std::string& name : names)
    if (!known.insert(name).second)
      throw std::invalid_argument("'" + name + "' is given twice among the " + what);
}

std::uint64_t mixed(std::uint64_t word) {  // splitmix64 (Steele et al., 2014)
  word += 0x9e3779b97f4a7c15U;
  word = (word ^ (word >> 30)) * 0xbf58476d1ce4e5b9U;
  word = (word ^ (word >> 27)) * 0x94d049bb133111ebU;
  return word ^ (word >> 31);
}

/// Returns the cells of a config, with room for @p halves halves each.
std::vector<FootballCell> cellsOf(const FootballConfig& config, std::uint64_t halves) {
  std::vector<FootballCell> cells;
  for (const std::string& league : config.leagues)
    for (const auto& [first, second] : config.pairs())
      cells.push_back({league, first, second, std::vector<FootballHalf>(halves)});
  return cells;
}

}  // namespace

std::string withTeamSight(const std::string& team, const std::string& sees) {
  const std::size_t plus = team.find('+');
  const std::string keeper = plus == team.npos ? "" : "+" + withSight(team.substr(plus + 1), sees);
  return withSight(team.substr(0, plus), sees) + keeper;
}

void FootballConfig::check() const {
  if (leagues.empty() || teams.empty())
    throw std::invalid_argument(std::string("there are no ") +
                                (teams.empty() ? "teams" : "leagues"));
  checkNames(leagues, "leagues");
  checkNames(teams, "teams");
  checkNames(against, "opponents");
  const auto known = footballLeagues();
  for (const std::string& league : leagues)
    if (std::find(known.begin(), known.end(), league) == known.end())
      throw std::invalid_argument("the league is '" + league + "', expected f2000 or msl");
  if (halves < 1 || halves > kMostHalves)
    throw std::invalid_argument("there are " + std::to_string(halves) +
                                " halves a pair, expected 1 to " + std::to_string(kMostHalves));
  if (!(seconds >= 0.0 && seconds <= kLongest))
    throw std::invalid_argument("a half has " + std::to_string(seconds) + " s, expected 0 to 7200");
  if (shard < 1 || shard > shards || shards > halves)
    throw std::invalid_argument("the shard is " + std::to_string(shard) + "/" +
                                std::to_string(shards) + " of " + std::to_string(halves) +
                                " halves, expected one from 1/N to N/N with N at most as many");
}

std::vector<std::string> FootballConfig::entrants() const {
  std::vector<std::string> all = teams;
  for (const std::string& one : against)
    if (std::find(all.begin(), all.end(), one) == all.end()) all.push_back(one);
  return all;
}

std::vector<std::pair<std::size_t, std::size_t>> FootballConfig::pairs() const {
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  const auto all = entrants();
  if (!against.empty()) {
    for (std::size_t i = 0; i < teams.size(); ++i)
      for (const std::string& other : against)
        pairs.emplace_back(i, std::find(all.begin(), all.end(), other) - all.begin());
    return pairs;
  }
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = i + 1; j < all.size(); ++j) pairs.emplace_back(i, j);
  if (pairs.empty()) pairs.emplace_back(0, 0);
  return pairs;
}

Interval FootballCell::mean(const std::function<double(const FootballHalf&)>& figure,
                            std::uint64_t seed) const {
  std::vector<double> values;
  double sum = 0.0;
  for (const FootballHalf& half : halves) values.push_back(figure(half)), sum += values.back();
  Random random(seed, 0);
  const auto n = static_cast<double>(values.size());
  std::vector<double> means;
  for (std::size_t i = 0; i < kResamples; ++i) {
    double drawn = 0.0;
    for (std::size_t k = 0; k < values.size(); ++k) drawn += values[random.below(values.size())];
    means.push_back(drawn / n);
  }
  return percentiles(sum / n, std::move(means));
}

std::uint64_t FootballCell::hash(const FootballConfig& config) const {
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < halves.size(); ++i) {
    const FootballHalf& half = halves[i];
    std::uint64_t word = mixed(numberOf(config, i));
    const auto add = [&](std::int64_t number) {
      word = mixed(word ^ static_cast<std::uint64_t>(number));
    };
    for (const auto& ofTeams : {half.goals, half.ownGoals, half.passes})
      for (const std::int32_t count : ofTeams) add(count);
    for (const std::int32_t count : {half.stuck, half.late}) add(count);
    for (const Timestamp time :
         {half.inPlay, half.unattended, half.longestAlone, half.longestIdle, half.longestStand})
      add(time);
    for (const PoseError& error : half.pose) add(error.position), add(error.heading);
    sum += mixed(word ^ half.digest);
  }
  return sum;
}

FootballMatrix playFootball(const FootballConfig& config, const FootballRun& run) {
  config.check();
  FootballMatrix matrix{config, {}, cellsOf(config, ownHalves(config))};
  {
    FootballHalves first;
    for (const std::string& league : config.leagues)
      matrix.worlds.push_back(first.fingerprint(league));
    for (const FootballCell& cell : matrix.cells) first.check(orderOf(config, cell, 0));
  }
  std::vector<Job> jobs;
  for (FootballCell& cell : matrix.cells)
    for (std::size_t i = 0; i < cell.halves.size(); ++i)
      jobs.push_back({orderOf(config, cell, numberOf(config, i)), &cell.halves[i]});
  play(jobs, run);
  return matrix;
}

FootballMatrix mergeFootball(std::span<const FootballMatrix> shards) {
  if (shards.empty()) throw std::invalid_argument("there are no shards");
  FootballMatrix whole{shards.front().config, shards.front().worlds, {}};
  whole.config.shard = whole.config.shards = 1;
  whole.cells = cellsOf(whole.config, whole.config.halves);
  const std::uint64_t n = shards.front().config.shards;
  if (shards.size() != n)
    throw std::invalid_argument("there are " + std::to_string(shards.size()) +
                                " shards, expected all " + std::to_string(n));
  std::set<std::uint64_t> seen;
  for (const FootballMatrix& shard : shards) {
    FootballConfig same = shard.config;
    same.shard = same.shards = 1;
    if (!(same == whole.config) || shard.config.shards != n || shard.worlds != whole.worlds)
      throw std::invalid_argument("shard " + std::to_string(shard.config.shard) +
                                  " is of another run: leagues, teams, halves, seed, worlds and "
                                  "number of shards must be the same");
    if (!seen.insert(shard.config.shard).second)
      throw std::invalid_argument("shard " + std::to_string(shard.config.shard) +
                                  " is given twice");
    for (std::size_t c = 0; c < shard.cells.size(); ++c)
      for (std::size_t i = 0; i < shard.cells[c].halves.size(); ++i)
        whole.cells[c].halves[numberOf(shard.config, i)] = shard.cells[c].halves[i];
  }
  return whole;
}

std::vector<FootballMismatch> verifyFootball(const FootballMatrix& matrix, std::uint64_t sample,
                                             std::uint64_t seed, const FootballRun& run,
                                             std::uint64_t& played) {
  Random random(seed, 0);
  std::vector<FootballMismatch> drawn;
  const std::uint64_t ofEach = std::max<std::uint64_t>(sample / matrix.cells.size(), 1);
  for (std::size_t c = 0; c < matrix.cells.size(); ++c) {
    const auto& halves = matrix.cells[c].halves;
    std::set<std::uint64_t> places;
    while (places.size() < std::min<std::uint64_t>(ofEach, halves.size()))
      places.insert(random.below(halves.size()));
    for (const std::uint64_t place : places)
      drawn.push_back({c, numberOf(matrix.config, place), halves[place], {}});
  }
  std::vector<Job> jobs;
  for (FootballMismatch& one : drawn)
    jobs.push_back({orderOf(matrix.config, matrix.cells[one.cell], one.number), &one.found});
  play(jobs, run);
  played = drawn.size();
  std::erase_if(drawn, [](const FootballMismatch& one) { return one.told == one.found; });
  return drawn;
}

}  // namespace ortung
