#include "ortung/benchmark/GoalMatrix.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <stdexcept>
#include <tuple>

#include "Jobs.hpp"
#include "ortung/base/Nearest.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/core/PluginFactory.hpp"
#include "ortung/sim/PlayerWish.hpp"

namespace ortung {
namespace {

constexpr std::array<std::string_view, 6> kPolicies = {"still",    "random",       "pattern",
                                                       "blocking", "intercepting", "mixed"};
constexpr std::array<std::string_view, 6> kKinds = {"roll",  "shot",   "dribble",
                                                    "feint", "seeker", "yardstick-v1"};
constexpr std::uint64_t kMostEpisodes = 10'000'000;

/// One episode to be played.
struct Job {
  const std::string* keeper = nullptr;
  const std::string* striker = nullptr;
  std::uint64_t number = 0;
  GoalEpisode* result = nullptr;
};

/// Plays all jobs with several threads.
void play(const std::vector<Job>& jobs, std::uint64_t seed, const GoalMatrixRun& run) {
  const auto tables = run.tables ? run.tables : std::make_shared<TableStore>(GoalEpisodes::world());
  doJobs(jobs.size(), run.threads, run.goesOn, [&] {
    return [&jobs, seed, episodes = std::make_unique<GoalEpisodes>(tables)](std::size_t i) {
      const Job& job = jobs[i];
      *job.result = episodes->play(*job.keeper, *job.striker, seed, job.number);
    };
  });
}

/// Returns the number of a shard's episodes of each pair.
std::uint64_t ownEpisodes(const GoalMatrixConfig& c) {
  return (c.episodes + c.shards - c.shard) / c.shards;
}
/// Returns the number of a shard's episode.
std::uint64_t numberOf(const GoalMatrixConfig& c, std::size_t place) {
  return c.shard - 1 + place * c.shards;
}

void checkNames(const std::vector<std::string>& names, const char* what) {
  if (names.empty()) throw std::invalid_argument(std::string("there are no ") + what);
  std::set<std::string> known;
  for (const std::string& name : names)
    if (!known.insert(name).second)
      throw std::invalid_argument("'" + name + "' is given twice among the " + what);
}

constexpr std::string_view kKeeper = "goalkeeper:policy=";
constexpr std::string_view kStriker = "striker:kind=";

/// Expands "blocking:delay_s=1" to a player's text; other texts stay as they are.
template <std::size_t N>
std::string expanded(const std::string& name, const std::array<std::string_view, N>& names,
                     std::string_view begin) {
  const std::size_t colon = std::min(name.find(':'), name.size());
  if (std::find(names.begin(), names.end(), name.substr(0, colon)) == names.end()) return name;
  std::string text = std::string(begin) + name;
  if (colon < name.size()) text[begin.size() + colon] = '&';
  return text;
}

/// Returns a player's text without its option `sees`.
std::string withoutSight(std::string text) {
  for (const char mark : {'&', ':'}) {
    const std::size_t at = text.find(mark + std::string("sees="));
    if (at == std::string::npos) continue;
    const std::size_t end = std::min(text.find_first_of("&@", at + 1), text.size());
    const bool hasMore = mark == ':' && end < text.size() && text[end] == '&';
    text.erase(hasMore ? at + 1 : at, end - at);
  }
  return text;
}

double middle(std::vector<double>& values) {
  const std::size_t half = values.size() / 2;
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(half),
                   values.end());
  return values[half];
}

std::optional<ErrorSummary> summaryOf(const std::vector<GoalEpisode>& episodes,
                                      PoseError GoalEpisode::* whose) {
  std::vector<double> positions;
  std::vector<double> headings;
  ErrorSummary summary;
  for (const GoalEpisode& episode : episodes) {
    const PoseError& error = episode.*whose;
    if (error.position == PoseError::kNone) continue;
    positions.push_back(1e-6 * error.position);
    headings.push_back(1e-6 * error.heading);
    summary.mean += positions.back();
    summary.meanHeading += headings.back();
  }
  if (positions.empty()) return std::nullopt;
  summary.episodes = positions.size();
  summary.mean /= static_cast<double>(positions.size());
  summary.meanHeading /= static_cast<double>(positions.size());
  summary.median = middle(positions);
  summary.medianHeading = middle(headings);
  return summary;
}

std::uint64_t mixed(std::uint64_t word) {  // splitmix64 (Steele et al., 2014)
  word += 0x9e3779b97f4a7c15U;
  word = (word ^ (word >> 30)) * 0xbf58476d1ce4e5b9U;
  word = (word ^ (word >> 27)) * 0x94d049bb133111ebU;
  return word ^ (word >> 31);
}

/// Draws @p count of the numbers below @p size, all of them if there are fewer. Returns them in
/// their order (Knuth, The art of computer programming 2, 3.4.2, algorithm S).
std::vector<std::uint64_t> drawnPlaces(std::uint64_t size, std::uint64_t count, Random& random) {
  std::vector<std::uint64_t> places;
  count = std::min(count, size);
  for (std::uint64_t place = 0; places.size() < count; ++place)
    if (random.below(size - place) < count - places.size()) places.push_back(place);
  return places;
}

/// Returns the policies or the kinds, whichever has a name near a plugin's, with that one first;
/// else both.
std::string shortNamesFor(const std::string& plugin) {
  std::string all;
  for (const auto& [what, begin, names] :
       {std::tuple{"policies of goalkeepers", kKeeper, kPolicies},
        {"kinds of strikers", kStriker, kKinds}}) {
    std::vector<std::string> words(names.begin(), names.end());
    const std::string meant = nearest(plugin, words);
    if (!meant.empty())
      std::rotate(words.begin(), std::find(words.begin(), words.end(), meant), words.end());
    std::string list = std::string(what) + " (" + std::string(begin) + "...) are ";
    for (const std::string& word : words) list += (&word == &words.front() ? "" : ", ") + word;
    if (!meant.empty()) return "did you mean '" + meant + "'? " + list;
    all += (all.empty() ? "" : "; ") + list;
  }
  return all;
}

}  // namespace

std::unique_ptr<Player> makeGoalPlayer(PluginFactory& factory, const PlayerWish& wish) {
  try {
    return factory.make<Player>(wish.plugin, wish.options);
  } catch (const PluginError& error) {
    const std::string text = error.what();
    const bool isMissing = text.find("there is no plugin '" + wish.plugin + "'") != text.npos;
    if (!isMissing) throw;
    throw PluginError(text + "; " + shortNamesFor(wish.plugin));
  }
}

std::span<const std::string_view> goalkeeperPolicies() { return kPolicies; }
std::span<const std::string_view> strikerKinds() { return kKinds; }

std::string keeperText(const std::string& name) { return expanded(name, kPolicies, kKeeper); }
std::string strikerText(const std::string& name) { return expanded(name, kKinds, kStriker); }

std::string shortName(const std::string& text) {
  for (const std::string_view begin : {kKeeper, kStriker}) {
    if (!text.starts_with(begin)) continue;
    std::string name = text.substr(begin.size());
    const std::size_t more = name.find('&');
    if (more != std::string::npos) name[more] = ':';
    return name;
  }
  return text;
}

std::string withSight(const std::string& keeper, const std::string& sees) {
  const std::string bare = withoutSight(keeper);
  return bare + (bare.find(':') == std::string::npos ? ":" : "&") + "sees=" + sees;
}

void GoalMatrixConfig::check() const {
  checkNames(keepers, "keepers");
  checkNames(strikers, "strikers");
  if (episodes < 1 || episodes > kMostEpisodes)
    throw std::invalid_argument("there are " + std::to_string(episodes) +
                                " episodes a pair, expected 1 to " + std::to_string(kMostEpisodes));
  if (shard < 1 || shard > shards || shards > episodes)
    throw std::invalid_argument("the shard is " + std::to_string(shard) + "/" +
                                std::to_string(shards) + " of " + std::to_string(episodes) +
                                " episodes, expected one from 1/N to N/N with N at most as many");
}

std::uint64_t GoalCell::count(GoalOutcome outcome) const {
  return static_cast<std::uint64_t>(
      std::count_if(episodes.begin(), episodes.end(),
                    [&](const GoalEpisode& episode) { return episode.outcome == outcome; }));
}

std::optional<double> GoalCell::meanTimeToScore() const {
  Timestamp sum = 0;
  for (const GoalEpisode& episode : episodes)
    if (episode.outcome == GoalOutcome::kGoal) sum += episode.end;
  const std::uint64_t goals = count(GoalOutcome::kGoal);
  if (goals == 0) return std::nullopt;
  return toSeconds(sum) / static_cast<double>(goals);
}

std::uint64_t GoalCell::hash(const GoalMatrixConfig& config) const {
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < episodes.size(); ++i) {
    std::uint64_t word = mixed(numberOf(config, i));
    word = mixed(word ^ static_cast<std::uint64_t>(episodes[i].outcome));
    word = mixed(word ^ static_cast<std::uint64_t>(episodes[i].end));
    for (const PoseError& error : {episodes[i].keeper, episodes[i].striker})
      if (error.position != PoseError::kNone)
        word = mixed(word ^ (static_cast<std::uint64_t>(error.position) << 32) ^
                     static_cast<std::uint64_t>(error.heading));
    sum += mixed(word ^ episodes[i].digest);
  }
  return sum;
}

std::optional<ErrorSummary> GoalCell::keeperError() const {
  return summaryOf(episodes, &GoalEpisode::keeper);
}
std::optional<ErrorSummary> GoalCell::strikerError() const {
  return summaryOf(episodes, &GoalEpisode::striker);
}

std::size_t GoalMatrix::baselineOf(std::size_t keeper) const {
  const std::string bare = withoutSight(config.keepers[keeper]);
  for (std::size_t k = 0; k < keeper; ++k)
    if (withoutSight(config.keepers[k]) == bare) return k;
  return 0;
}

Interval GoalMatrix::difference(std::size_t keeper, std::size_t other, std::size_t striker) const {
  const auto& a = cell(keeper, striker).episodes;
  const auto& b = cell(other, striker).episodes;
  std::vector<int> differences;
  for (std::size_t i = 0; i < a.size(); ++i)
    differences.push_back(int{a[i].outcome == GoalOutcome::kGoal} -
                          int{b[i].outcome == GoalOutcome::kGoal});
  return pairedBootstrap(differences, config.seed);
}

GoalMatrix playMatrix(const GoalMatrixConfig& config, const GoalMatrixRun& run) {
  config.check();
  GoalMatrix matrix{config, {}, {}};
  GoalEpisodes first;
  matrix.world = first.fingerprint();
  for (const std::string& keeper : config.keepers)
    for (const std::string& striker : config.strikers) {
      first.check(keeper, striker);
      matrix.cells.push_back({keeper, striker, {}});
      matrix.cells.back().episodes.resize(ownEpisodes(config));
    }
  std::vector<Job> jobs;
  for (GoalCell& cell : matrix.cells)
    for (std::size_t i = 0; i < cell.episodes.size(); ++i)
      jobs.push_back({&cell.keeper, &cell.striker, numberOf(config, i), &cell.episodes[i]});
  play(jobs, config.seed, run);
  return matrix;
}

GoalMatrix mergeShards(std::span<const GoalMatrix> shards) {
  if (shards.empty()) throw std::invalid_argument("there are no shards");
  GoalMatrix whole{shards.front().config, shards.front().world, {}};
  whole.config.shard = whole.config.shards = 1;
  const std::uint64_t n = shards.front().config.shards;
  if (shards.size() != n)
    throw std::invalid_argument("there are " + std::to_string(shards.size()) +
                                " shards, expected all " + std::to_string(n));
  for (const std::string& keeper : whole.config.keepers)
    for (const std::string& striker : whole.config.strikers) {
      whole.cells.push_back({keeper, striker, {}});
      whole.cells.back().episodes.resize(whole.config.episodes);
    }
  std::set<std::uint64_t> seen;
  for (const GoalMatrix& shard : shards) {
    GoalMatrixConfig same = shard.config;
    same.shard = same.shards = 1;
    if (!(same == whole.config) || shard.config.shards != n || shard.world != whole.world)
      throw std::invalid_argument("shard " + std::to_string(shard.config.shard) +
                                  " is of another run: keepers, strikers, episodes, seed, world "
                                  "and number of shards must be the same");
    if (!seen.insert(shard.config.shard).second)
      throw std::invalid_argument("shard " + std::to_string(shard.config.shard) +
                                  " is given twice");
    for (std::size_t c = 0; c < shard.cells.size(); ++c)
      for (std::size_t i = 0; i < shard.cells[c].episodes.size(); ++i)
        whole.cells[c].episodes[numberOf(shard.config, i)] = shard.cells[c].episodes[i];
  }
  return whole;
}

std::vector<GoalMismatch> verify(const GoalMatrix& matrix, std::uint64_t sample, std::uint64_t seed,
                                 const GoalMatrixRun& run, std::uint64_t& played) {
  Random random(seed, 0);
  const std::size_t cells = matrix.cells.size();
  const std::uint64_t ofEach = sample / cells;
  const std::vector<std::uint64_t> withOneMore = drawnPlaces(cells, sample % cells, random);
  std::vector<GoalMismatch> drawn;
  for (std::size_t c = 0; c < cells; ++c) {
    const GoalCell& cell = matrix.cells[c];
    const bool isMore = std::binary_search(withOneMore.begin(), withOneMore.end(), c);
    for (const std::uint64_t place :
         drawnPlaces(cell.episodes.size(), ofEach + (isMore ? 1 : 0), random))
      drawn.push_back(
          {cell.keeper, cell.striker, numberOf(matrix.config, place), cell.episodes[place], {}});
  }
  std::vector<Job> jobs;
  for (GoalMismatch& one : drawn)
    jobs.push_back({&one.keeper, &one.striker, one.number, &one.found});
  play(jobs, matrix.config.seed, run);
  played = drawn.size();
  std::erase_if(drawn, [](const GoalMismatch& one) { return one.told == one.found; });
  return drawn;
}

}  // namespace ortung
