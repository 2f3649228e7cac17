#include "ortung/learning/Batch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "Episode.hpp"
#include "Settings.hpp"
#include "ortung/base/Workers.hpp"

namespace ortung::learning {
namespace {

constexpr std::size_t kMostEpisodes = 65'536;
constexpr unsigned kMostThreads = 256;
/// Chunks per thread, so that threads end at about the same time.
constexpr std::size_t kChunksPerThread = 4;
/// Number of episodes from which a core's caches do not keep one until its next turn.
constexpr std::size_t kMany = 128;

/// A place in which consecutive episodes are played.
struct Slot {
  Options options;
  std::shared_ptr<const Settings> settings;
  std::uint64_t seed = 0;
  std::uint64_t number = 0;
  std::filesystem::path record;
  std::unique_ptr<Episode> episode;
};

}  // namespace

std::string_view nameOf(Ending ending) {
  constexpr std::array<std::string_view, 5> kNames = {"", "goal", "saved", "out", "time"};
  return kNames[static_cast<std::size_t>(ending)];
}

void BatchConfig::check() const {
  if (episodes < 1 || episodes > kMostEpisodes)
    throw std::invalid_argument("BatchConfig::episodes is " + std::to_string(episodes) +
                                ", must be in [1, " + std::to_string(kMostEpisodes) + "]");
  if (threads > kMostThreads)
    throw std::invalid_argument("BatchConfig::threads is " + std::to_string(threads) +
                                ", must be in [0, " + std::to_string(kMostThreads) + "]");
}

struct Batch::Parts {
  const EnvironmentInfo& info;
  BatchConfig config;
  std::size_t width;  ///< number of values per action
  Field field;
  Workers workers;
  std::vector<std::unique_ptr<Stand>> stands;  ///< shared data of each chunk's episodes
  std::vector<std::exception_ptr> failures;    ///< first failure in each chunk
  std::vector<Slot> slots;
  std::vector<float> observations;
  std::vector<float> finals;
  std::vector<double> rewards;
  std::vector<std::uint8_t> terminated;
  std::vector<std::uint8_t> truncated;
  std::vector<std::uint8_t> endings;
  std::vector<std::uint64_t> seeds;
  std::vector<std::uint64_t> numbers;
  std::vector<float> states;

  Parts(const EnvironmentInfo& environment, const BatchConfig& c)
      : info(environment), config(c), width(environment.actionSize()), workers(threadsOf(c)) {
    const std::size_t n = c.episodes;
    slots.resize(n);
    stands.resize(std::min(n, kChunksPerThread * threadsOf(c)));
    failures.resize(stands.size());
    observations.resize(n * agents() * info.observation.size());
    finals.resize(observations.size());
    rewards.resize(n * agents());
    terminated.resize(n);
    truncated.resize(n);
    endings.resize(n);
    seeds.resize(n);
    numbers.resize(n);
    states.resize(n * Episode::kState);
  }

  static unsigned threadsOf(const BatchConfig& c) {
    return c.threads > 0 ? c.threads : std::max(1u, std::thread::hardware_concurrency());
  }
  std::size_t agents() const { return info.agents.size(); }
  std::size_t seen() const { return agents() * info.observation.size(); }
  std::size_t firstOf(std::size_t chunk) const { return chunk * slots.size() / stands.size(); }
  std::size_t chunkOf(std::size_t slot) const {
    std::size_t chunk = slot * stands.size() / slots.size();
    while (firstOf(chunk + 1) <= slot) ++chunk;
    return chunk;
  }
  std::string nameOf(std::size_t slot) const {
    return "episode " + std::to_string(slot) + " of " + info.id;
  }

  template <class Work>
  void forChunks(const Work& work);
  /// Calls work(stand, i) for all slots, as forChunks().
  template <class Work>
  void forAll(const Work& work) {
    forChunks([&work](Stand& stand, std::size_t first, std::size_t end) {
      for (std::size_t i = first; i < end; ++i) work(stand, i);
    });
  }
  Stand& standOf(std::size_t chunk) {
    if (!stands[chunk]) stands[chunk] = std::make_unique<Stand>(field);
    return *stands[chunk];
  }
  void begin(Stand& stand, std::size_t i);
  void restart(Stand& stand, std::size_t i, std::optional<std::uint64_t> seed);
  void step(Stand& stand, std::size_t i, std::span<const float> actions, const Episode* next);
  void clear(std::size_t i);
  void look(std::size_t i);
  void checkActions(std::span<const float> actions) const;
  std::shared_ptr<const Settings> read(std::size_t slot, const Options& options);
};

/// Calls work(stand, first, end) for the slots [first, end) of each chunk. The first exception, in
/// the order of slots, is rethrown when all are done.
template <class Work>
void Batch::Parts::forChunks(const Work& work) {
  workers.run(stands.size(), [&](std::size_t chunk) {
    failures[chunk] = nullptr;
    try {
      work(standOf(chunk), firstOf(chunk), firstOf(chunk + 1));
    } catch (...) {
      failures[chunk] = std::current_exception();
    }
  });
  for (const std::exception_ptr& failure : failures)
    if (failure) std::rethrow_exception(failure);
}

void Batch::Parts::clear(std::size_t i) {
  std::fill_n(rewards.begin() + static_cast<std::ptrdiff_t>(i * agents()), agents(), 0.0);
  terminated[i] = truncated[i] = endings[i] = 0;
}

/// Begins the episode of the slot's seed and number.
void Batch::Parts::begin(Stand& stand, std::size_t i) {
  Slot& slot = slots[i];
  slot.episode.reset();
  slot.episode =
      std::make_unique<Episode>(stand, slot.settings, slot.seed, slot.number, slot.record);
  seeds[i] = slot.seed;
  numbers[i] = slot.number;
  look(i);
}

/// Begins an episode from outside: with a seed number 0, without one the next number.
void Batch::Parts::restart(Stand& stand, std::size_t i, std::optional<std::uint64_t> seed) {
  Slot& slot = slots.at(i);
  slot.number = seed ? 0 : slot.number + 1;
  if (seed) slot.seed = *seed;
  clear(i);
  begin(stand, i);
}

void Batch::Parts::look(std::size_t i) {
  slots[i].episode->observe(std::span(observations).subspan(i * seen(), seen()));
  slots[i].episode->state(std::span(states).subspan(i * Episode::kState, Episode::kState));
}

/// @param next see Episode::step()
void Batch::Parts::step(Stand& stand, std::size_t i, std::span<const float> actions,
                        const Episode* next) {
  Slot& slot = slots[i];
  clear(i);
  if (!slot.episode || slot.episode->isOver()) {  // no episode: a player was stopped
    ++slot.number;
    return begin(stand, i);
  }
  try {
    slot.episode->step(actions.subspan(i * agents() * width, agents() * width), width, next);
  } catch (...) {
    slot.episode.reset();
    throw;
  }
  const Ending ending = slot.episode->ending();
  slot.episode->reward(std::span(rewards).subspan(i * agents(), agents()));
  look(i);
  if (ending == Ending::kNone) return;
  endings[i] = static_cast<std::uint8_t>(ending);
  (ending == Ending::kTime ? truncated : terminated)[i] = 1;
  if (config.autoreset != Autoreset::kSameStep) return;
  std::copy_n(observations.begin() + static_cast<std::ptrdiff_t>(i * seen()), seen(),
              finals.begin() + static_cast<std::ptrdiff_t>(i * seen()));
  ++slot.number;
  begin(stand, i);
}

void Batch::Parts::checkActions(std::span<const float> actions) const {
  const std::size_t expected = slots.size() * agents() * width;
  if (actions.size() != expected)
    throw std::invalid_argument(
        info.id + ": actions of " + std::to_string(actions.size()) + " numbers, expected " +
        std::to_string(expected) + " (" + std::to_string(slots.size()) + " episodes, " +
        std::to_string(agents()) + " agents, " + std::to_string(width) + " numbers)");
  for (std::size_t k = 0; k < expected; ++k) {
    if (std::isfinite(actions[k])) continue;
    const std::size_t agent = k / width % agents();
    if (k % width >= info.actions[agent].size()) continue;  // unused by this agent
    throw std::invalid_argument(nameOf(k / width / agents()) + ": the action of " +
                                info.agents[agent] + " has " + std::to_string(actions[k]) +
                                " as '" + info.actions[agent][k % width].name +
                                "', expected a finite number");
  }
  if (config.autoreset != Autoreset::kDisabled) return;
  for (std::size_t i = 0; i < slots.size(); ++i)
    if (!slots[i].episode || slots[i].episode->isOver())
      throw std::logic_error(nameOf(i) + " is over, and must be reset before it is stepped again");
}

std::shared_ptr<const Settings> Batch::Parts::read(std::size_t slot, const Options& options) {
  auto settings = std::make_shared<const Settings>(Settings::read(info, options));
  standOf(chunkOf(slot)).check(*settings);
  return settings;
}

Batch::Batch(std::string_view id, const Options& options, const BatchConfig& config) {
  const EnvironmentInfo& info = environment(id);
  config.check();
  parts_ = std::make_unique<Parts>(info, config);
  setOptions(options);
  std::vector<std::uint64_t> seeds(config.episodes);
  for (std::size_t i = 0; i < seeds.size(); ++i) seeds[i] = config.seed + i;
  reset(seeds);
}

Batch::~Batch() = default;

const EnvironmentInfo& Batch::info() const { return parts_->info; }
std::size_t Batch::size() const { return parts_->slots.size(); }
Autoreset Batch::autoreset() const { return parts_->config.autoreset; }

void Batch::reset(std::span<const std::uint64_t> seeds) {
  if (seeds.size() != size())
    throw std::invalid_argument(info().id + ": " + std::to_string(seeds.size()) +
                                " seeds, expected " + std::to_string(size()));
  parts_->forAll([&](Stand& stand, std::size_t i) { parts_->restart(stand, i, seeds[i]); });
}

void Batch::reset() {
  parts_->forAll([&](Stand& stand, std::size_t i) { parts_->restart(stand, i, std::nullopt); });
}

void Batch::reset(std::size_t episode, std::optional<std::uint64_t> seed) {
  parts_->restart(parts_->standOf(parts_->chunkOf(episode)), episode, seed);
}

void Batch::reset(std::span<const std::uint8_t> places,
                  std::span<const std::optional<std::uint64_t>> seeds) {
  if (places.size() != size() || (!seeds.empty() && seeds.size() != size()))
    throw std::invalid_argument(info().id + ": " + std::to_string(places.size()) + " flags and " +
                                std::to_string(seeds.size()) + " seeds, expected " +
                                std::to_string(size()) + " of each, or no seeds");
  parts_->forAll([&](Stand& stand, std::size_t i) {
    if (places[i] != 0) parts_->restart(stand, i, seeds.empty() ? std::nullopt : seeds[i]);
  });
}

void Batch::setOptions(const Options& options) {
  const auto settings = parts_->read(0, options);
  for (Slot& slot : parts_->slots) slot.options = options, slot.settings = settings;
}

void Batch::setOptions(std::size_t episode, const Options& options) {
  Slot& slot = parts_->slots.at(episode);
  Options all = slot.options;
  for (const auto& [key, value] : options) all.insert_or_assign(key, value);
  slot.settings = parts_->read(episode, all);
  slot.options = std::move(all);
}

void Batch::record(std::size_t episode, const std::filesystem::path& file) {
  Slot& slot = parts_->slots.at(episode);
  slot.record = file;
  if (slot.episode) slot.episode->endRecord();
}

void Batch::step(std::span<const float> actions) {
  parts_->checkActions(actions);
  parts_->forChunks([&](Stand& stand, std::size_t first, std::size_t end) {
    const bool areMany = parts_->slots.size() >= kMany;
    for (std::size_t i = first; i < end; ++i)
      parts_->step(stand, i, actions,
                   areMany && i + 1 < end ? parts_->slots[i + 1].episode.get() : nullptr);
  });
}

std::span<const float> Batch::observations() const { return parts_->observations; }
std::span<const float> Batch::finalObservations() const { return parts_->finals; }
std::span<const double> Batch::rewards() const { return parts_->rewards; }
std::span<const std::uint8_t> Batch::terminated() const { return parts_->terminated; }
std::span<const std::uint8_t> Batch::truncated() const { return parts_->truncated; }
std::span<const std::uint8_t> Batch::endings() const { return parts_->endings; }
std::span<const std::uint64_t> Batch::seeds() const { return parts_->seeds; }
std::span<const std::uint64_t> Batch::numbers() const { return parts_->numbers; }
std::span<const float> Batch::states() const { return parts_->states; }

}  // namespace ortung::learning
