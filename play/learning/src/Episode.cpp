#include "Episode.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "ortung/base/Nearest.hpp"
#include "ortung/benchmark/GoalMatrix.hpp"
#include "ortung/core/ShippedFiles.hpp"
#include "ortung/robot/RobotFile.hpp"

namespace ortung::learning {
namespace {

// Random streams of an episode's seed. They are those of the benchmark, so that a striker that does
// not look at the keeper makes the same situations for the same seed and number.
enum Stream : std::uint64_t { kSimulation, kPlacing, kOfKeeper, kOfStriker };

constexpr const char* kBlue = "blue";      ///< the keeper's team, and the name of its robot
constexpr const char* kYellow = "yellow";  ///< the striker's team, and the name of its robot
constexpr double kKeeperLine = 0.5;        ///< distance of the keeper's line from the goal line [m]
constexpr double kKeeperReach = 0.7;       ///< greatest distance of its start from the middle [m]
/// Pose of the striker until it makes its situation.
constexpr Pose2 kStrikerWaits{3.0, 0.0, std::numbers::pi};
/// Distance from the striker's middle to a ball at its kicker [m].
constexpr double kBallAhead = 0.285;
constexpr int kTries = 50;
/// Greatest distance of the episode's memory from itself [bytes].
constexpr std::uintptr_t kMemoryReach = 192 * 1024;
constexpr std::size_t kCacheLine = 64;  ///< [bytes]

Simulation::Config configOf(const Settings& settings, Random seeds) {
  Simulation::Config config;
  config.seed = (std::uint64_t{seeds.next()} << 32) | seeds.next();
  config.cycle = settings.cycle;
  config.likeVersion02 = true;  // what the environments' versions promise
  return config;
}

PlayerControl::Config supervise(std::string& problem, std::shared_ptr<TableStore> tables) {
  PlayerControl::Config config;
  config.budget = 0.0;  // a limit of time would make episodes differ
  config.onProblem = [&problem](const std::string& what) { problem = what; };
  config.tables = std::move(tables);
  return config;
}

/// Returns the names with the nearest one first, and a question if one is near.
std::string nearestFirst(const std::string& word, std::span<const std::string_view> names) {
  std::vector<std::string> words(names.begin(), names.end());
  const std::string meant = nearest(word, words);
  if (!meant.empty())
    std::rotate(words.begin(), std::find(words.begin(), words.end(), meant), words.end());
  std::string all;
  for (const std::string& one : words) all += (all.empty() ? "" : ", ") + one;
  return all + (meant.empty() ? "" : " (did you mean '" + meant + "'?)");
}

/// Asks for memory that will be written to. With many episodes most of what memory costs is the
/// look-up of addresses in page tables, and prefetching for readers may be dropped where it would
/// need one; prefetching for writers is not.
void askToWrite(std::span<const std::byte> memory) {
  for (std::size_t at = 0; at < memory.size(); at += kCacheLine) {
    const std::byte* line = memory.data() + at;
#ifdef __x86_64__
    asm volatile("prefetchw %0" : : "m"(*line));  // older processors ignore it
#else
    __builtin_prefetch(line, 1);
    asm volatile(""
                 :
                 : "r"(line));  // or the compiler leaves out the calls, as nothing comes of them
#endif
  }
}

/// Returns the pages between two addresses that have memory, which they get when they are written
/// to first.
std::vector<std::span<const std::byte>> writtenBetween(std::uintptr_t first, std::uintptr_t last) {
  const auto page = static_cast<std::uintptr_t>(::sysconf(_SC_PAGESIZE));
  first = first / page * page;
  std::vector<unsigned char> isThere((last - first + page - 1) / page, 1);
  if (::mincore(reinterpret_cast<void*>(first), last - first, isThere.data()) != 0)
    isThere.assign(isThere.size(), 1);
  std::vector<std::span<const std::byte>> pieces;
  std::size_t end = 0;
  for (std::size_t begin = 0; begin < isThere.size(); begin = end + 1) {
    const auto hasMemory = [&](std::size_t i) { return (isThere[i] & 1U) != 0; };
    end = begin;
    while (end < isThere.size() && hasMemory(end)) ++end;
    if (end > begin)
      pieces.emplace_back(reinterpret_cast<const std::byte*>(first + begin * page),
                          (end - begin) * page);
  }
  return pieces;
}

/// Makes the player of an option. An unknown one is told with the names that the option has.
std::unique_ptr<Player> entrantPlayer(PluginFactory& factory, const PlayerWish& wish,
                                      std::string_view name) {
  try {
    return factory.make<Player>(wish.plugin, wish.options);
  } catch (const PluginError& error) {
    const std::string text = error.what();
    if (text.find("there is no plugin '" + wish.plugin + "'") == text.npos) throw;
    const bool keeps = name == kBlue;
    throw PluginError((keeps ? "keeper is '" : "striker is '") + wish.plugin + "', expected " +
                      nearestFirst(wish.plugin, keeps ? goalkeeperPolicies() : strikerKinds()) +
                      ", or a player's text (PLUGIN:key=value): " + text);
  }
}

}  // namespace

Field::Field()
    : file(shippedFile("fields", "f2000.toml")),
      world(readWorld(file)),
      tables(std::make_shared<TableStore>(file)) {}

Stand::Stand(const Field& shared)
    : field(shared), factory(PluginFactory::standardFolders()), plans(*shared.world) {}

Stand::Entrant& Stand::entrant(const std::string& text, const char* name) {
  const std::string key = name + (" " + text);
  const auto known = entrants_.find(key);
  if (known != entrants_.end()) return known->second;
  Entrant entrant;
  entrant.wish = parsePlayer(text);
  PlayerWish& wish = entrant.wish;
  if (!wish.team.empty() || !wish.name.empty() || wish.start)
    throw ConfigError("player '" + text +
                      "': the environment sets team, name and start, so they can't be given");
  const auto player = entrantPlayer(factory, wish, name);
  const auto file = wish.robot.empty() ? player->robotFile() : wish.robot;
  if (file.empty())
    throw ConfigError("player '" + text +
                      "' names no robot file, so one must be given (robot=FILE)");
  entrant.robot = readRobot(shippedFile("robots", file));
  wish.team = wish.name = entrant.robot.name = name;
  return entrants_.emplace(key, std::move(entrant)).first->second;
}

Stand::Entrant& Stand::agent(const std::filesystem::path& robot, const char* name) {
  const std::string key = name + (" agent " + robot.string());
  const auto known = entrants_.find(key);
  if (known != entrants_.end()) return known->second;
  Entrant entrant;
  entrant.robot = readRobot(shippedFile("robots", robot));
  entrant.wish.plugin = "agent";
  entrant.wish.team = entrant.wish.name = entrant.robot.name = name;
  return entrants_.emplace(key, std::move(entrant)).first->second;
}

Stand::Entrant& Stand::keeperOf(const Settings& s) {
  return s.keeperIsAgent() ? agent(s.keeperRobot, kBlue) : entrant(s.keeper, kBlue);
}

Stand::Entrant& Stand::strikerOf(const Settings& s) {
  return s.strikerIsAgent() ? agent(s.strikerRobot, kYellow) : entrant(s.striker, kYellow);
}

void Stand::check(const Settings& settings) {
  keeperOf(settings);
  strikerOf(settings);
}

Episode::Episode(Stand& stand, std::shared_ptr<const Settings> settings, std::uint64_t seed,
                 std::uint64_t number, const std::filesystem::path& record)
    : stand_(stand),
      settings_(std::move(settings)),
      seed_(seed),
      number_(number),
      simulation_(stand.field.world->another(), configOf(*settings_, stream(kSimulation))),
      control_(simulation_, stand.plans, stand.factory, supervise(problem_, stand.field.tables)) {
  const Settings& s = *settings_;
  Random placing = stream(kPlacing);
  Stand::Entrant& keeps = stand.keeperOf(s);
  Stand::Entrant& strikes = stand.strikerOf(s);
  keeper_ =
      &simulation_.addRobot(keeps.robot, stand.factory,
                            {kGoalLine + kKeeperLine, placing.uniform(-kKeeperReach, kKeeperReach),
                             std::numbers::pi / 2.0});
  striker_ = &simulation_.addRobot(strikes.robot, stand.factory, kStrikerWaits);
  if (s.strikerIsAgent()) placeStriker();
  seat(keeps, *keeper_, s.keeperIsAgent(), false);
  seat(strikes, *striker_, s.strikerIsAgent(), true);
  checkPlayers();
  if (!record.empty()) beginRecord(record);
  sense();
  findMemory();
}

Episode::~Episode() = default;

/// What it consists of was made in one go, and what was there before has left its room to it. So
/// nearly all of it lies between the parts that are known here. In between is also what nothing was
/// ever written to: the physics engine has a stack of 100 kB, of which it needs little.
void Episode::findMemory() {
  const auto addressOf = [](const void* part) { return reinterpret_cast<std::uintptr_t>(part); };
  const std::uintptr_t middle = addressOf(this);
  std::uintptr_t first = middle;
  std::uintptr_t last = middle + sizeof(Episode);
  const auto take = [&](const void* part, std::size_t size) {
    const std::uintptr_t begin = addressOf(part);
    if (begin + kMemoryReach < middle || begin > middle + kMemoryReach) return;
    first = std::min(first, begin);
    last = std::max(last, begin + size);
  };
  take(&simulation_.world(), sizeof(SimWorld));
  take(simulation_.things().data(), simulation_.things().size_bytes());
  for (const SimRobot* robot : {keeper_, striker_}) {
    take(robot, sizeof(SimRobot));
    take(&robot->drive(), sizeof(Drive));
    for (const auto& data : robot->container().all()) take(data.get(), sizeof(SensorData));
  }
  for (const Agent* agent : agents_) take(agent, sizeof(Agent));
  memory_ = writtenBetween(first, last);
}

void Episode::prefetch(int part, int parts) const {
  const auto share = [parts](std::size_t all, int upTo) {
    return all * static_cast<std::size_t>(upTo) / static_cast<std::size_t>(parts);
  };
  for (const std::span<const std::byte> piece : memory_) {
    const std::size_t lines = piece.size() / kCacheLine;
    const std::size_t from = share(lines, part);
    askToWrite(piece.subspan(from * kCacheLine, (share(lines, part + 1) - from) * kCacheLine));
  }
}

/// Places the striker with the ball at its kicker. If it must localize itself, it may be farther
/// away and face less towards the goal.
void Episode::placeStriker() {
  Random random = stream(kOfStriker);
  const bool isLost = settings_->task == Task::kLocalize;
  for (int i = 0; i < kTries; ++i) {
    Pose2 pose{kGoalLine + random.uniform(3.0, isLost ? 6.0 : 4.5),
               random.uniform(-1.0, 1.0) * (isLost ? 2.5 : 1.5), 0.0};
    const double turned = random.uniform(-1.0, 1.0) * (isLost ? 1.0 : 0.2);
    pose.theta = wrapAngle(std::atan2(-pose.y, kGoalLine - pose.x) + turned);
    const Pose2 ball = pose * Pose2{kBallAhead, 0.0, 0.0};
    if (hasPlaced(pose, ball)) return;
  }
  throw std::runtime_error("found no room for striker and ball");
}

/// @return whether there was room for both
bool Episode::hasPlaced(const Pose2& striker, const Pose2& ball) {
  try {
    simulation_.place(*striker_, striker);
    simulation_.placeThing(0, {ball.x, ball.y, 0.0});
    return true;
  } catch (const std::invalid_argument&) {
    return false;
  }
}

void Episode::seat(Stand::Entrant& entrant, SimRobot& robot, bool isAgent, bool isStriker) {
  // An agent's place was drawn from this stream, so it gets another one.
  const Random random = stream(isStriker ? kOfStriker : kOfKeeper).fork(isAgent ? 1 : 0);
  if (!isAgent)
    return control_.own(robot, control_.make(entrant.wish), entrant.wish,
                        stream(isStriker ? kOfStriker : kOfKeeper));
  const double speed = isStriker ? settings_->strikerSpeed : settings_->keeperSpeed;
  auto agent = std::make_unique<Agent>(*settings_, isStriker, speed, robot);
  agents_.push_back(agent.get());
  control_.own(robot, std::move(agent), entrant.wish, random);
}

void Episode::checkPlayers() const {
  if (problem_.empty()) return;
  throw std::runtime_error("episode " + std::to_string(number_) + " of seed " +
                           std::to_string(seed_) + ": " + problem_);
}

void Episode::beginRecord(const std::filesystem::path& file) {
  const SimRobot& robot = settings_->keeperIsAgent() ? *keeper_ : *striker_;
  record_ = std::make_unique<EpisodeRecord>(EpisodeRecord::fileOf(file, seed_, number_),
                                            stand_.field.world->fingerprint(), robot.container());
}

void Episode::sense() {
  simulation_.sense();
  for (Agent* agent : agents_) agent->look(simulation_.now());
  if (record_) record_->write(simulation_.readings(settings_->keeperIsAgent() ? 0 : 1));
}

void Episode::step(std::span<const float> actions, std::size_t width, const Episode* next) {
  for (std::size_t i = 0; i < agents_.size(); ++i)
    agents_[i]->setAction(actions.subspan(i * width, width));
  const Game game;
  for (int i = 0; i < settings_->cycles && !isOver(); ++i) {
    if (next != nullptr) next->prefetch(i, settings_->cycles);
    control_.act(game);
    checkPlayers();
    simulation_.move();
    if (judge_.sees(simulation_.things().front(), *keeper_, simulation_.cycle()))
      ending_ = static_cast<Ending>(static_cast<int>(judge_.outcome()) + 1);
    sense();
  }
  if (++steps_ >= settings_->steps && !isOver()) ending_ = Ending::kTime;
  if (isOver()) endRecord();
}

void Episode::endRecord() {
  if (!record_) return;
  record_->end();
  record_.reset();
}

void Episode::observe(std::span<float> out) {
  const std::size_t size = out.size() / agents_.size();
  const double left = settings_->step() * (settings_->steps - steps_);
  for (std::size_t i = 0; i < agents_.size(); ++i)
    agents_[i]->observe(simulation_.now(), left, out.subspan(i * size, size));
}

/// Writes the rewards: what the striker wins the keeper loses.
void Episode::reward(std::span<double> out) const {
  const double scored = ending_ == Ending::kGoal ? 1.0 : ending_ == Ending::kSaved ? -1.0 : 0.0;
  std::size_t agent = 0;
  if (settings_->keeperIsAgent()) out[agent++] = scored == 0.0 ? 0.0 : -scored;
  if (settings_->strikerIsAgent()) out[agent] = scored;
}

void Episode::state(std::span<float> out) const {
  const Simulation::Thing& ball = simulation_.things().front();
  const Pose2& keeper = keeper_->state().pose;
  const Pose2& striker = striker_->state().pose;
  const std::array<double, kState> all = {toSeconds(simulation_.now()),
                                          ball.pose.x,
                                          ball.pose.y,
                                          ball.velocity.x,
                                          ball.velocity.y,
                                          keeper.x,
                                          keeper.y,
                                          keeper.theta,
                                          striker.x,
                                          striker.y,
                                          striker.theta,
                                          judge_.wasShot() ? 1.0 : 0.0};
  for (std::size_t i = 0; i < kState; ++i) out[i] = static_cast<float>(all[i]);
}

}  // namespace ortung::learning
