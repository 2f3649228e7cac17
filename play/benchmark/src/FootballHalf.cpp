#include "ortung/benchmark/FootballHalf.hpp"

#include <algorithm>
#include <stdexcept>

#include "FootballWatch.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/core/PluginFactory.hpp"
#include "ortung/core/ShippedFiles.hpp"
#include "ortung/sim/PlayerControl.hpp"
#include "ortung/sim_api/Referee.hpp"

namespace ortung {
namespace {

constexpr std::array<std::string_view, 2> kLeagues = {"f2000", "msl"};
constexpr const char* kKeeper = "goalkeeper";  ///< the plugin that keeps goals in scenes
constexpr const char* kFrozen = "footballer-v1";

/// Returns the keeper that the frozen team has in a league, which is frozen as well.
std::string frozenKeeper(const std::string& league) {
  const std::string keeper = "goalkeeper-v1:policy=intercepting&delay_s=0.2";
  return keeper + (league == "msl" ? "&speed_m_s=1.3&comes_out_m=2&reach_m=1"
                                   : "&speed_m_s=0.7&comes_out_m=1.6");
}

/// @throws std::invalid_argument
std::filesystem::path sceneFile(const std::string& league) {
  if (std::find(kLeagues.begin(), kLeagues.end(), league) == kLeagues.end())
    throw std::invalid_argument("the league is '" + league + "', expected f2000 or msl");
  return shippedFile("scenes", league + "_match.toml");
}

PlayerWish wishIn(const std::string& text, const std::string& team) {
  PlayerWish wish = parsePlayer(text);
  if (!wish.team.empty() || !wish.name.empty() || wish.start)
    throw ConfigError("team '" + team +
                      "': the benchmark sets team, name and start, so they can't be given");
  return wish;
}

/// Puts a player in the place of another one, on its robot unless it has one of its own.
void replace(PlayerWish& place, PlayerWish wish) {
  wish.team = place.team;
  wish.name = place.name;
  wish.start = place.start;
  if (wish.robot.empty()) wish.robot = place.robot;
  place = std::move(wish);
}

/// Lets the keeper of a scene see as its team does, with a robot that has the sensors for it.
void letSee(PlayerWish& keeper, const FootballTeam& team, PluginFactory& factory) {
  if (!team.player.options.has("sees")) return;
  keeper.options.set("sees", Parameters(team.player.options).text("sees"));
  keeper.robot = factory.make<Player>(keeper.plugin, keeper.options)->robotFile();
}

}  // namespace

std::span<const std::string_view> footballLeagues() { return kLeagues; }

FootballTables footballTables() {
  FootballTables tables;
  for (const std::string_view league : kLeagues) {
    const std::string name(league);
    tables[name] = std::make_shared<TableStore>(Scene::read(sceneFile(name)).world);
  }
  return tables;
}

FootballTeam FootballTeam::parse(const std::string& text) {
  const std::size_t plus = text.find('+');
  FootballTeam team{wishIn(text.substr(0, plus), text), std::nullopt};
  if (plus != text.npos) team.keeper = wishIn(text.substr(plus + 1), text);
  return team;
}

struct FootballHalves::Parts {
  PluginFactory factory{PluginFactory::standardFolders()};
  FootballTables tables;
};

FootballHalves::FootballHalves(FootballTables tables) : parts_(std::make_unique<Parts>()) {
  parts_->tables = std::move(tables);
}
FootballHalves::~FootballHalves() = default;

std::string FootballHalves::fingerprint(const std::string& league) const {
  return readWorld(Scene::read(sceneFile(league)).world)->fingerprint();
}

Scene FootballHalves::sceneOf(const Order& order, PluginFactory& factory) {
  Scene scene = Scene::read(sceneFile(order.league));
  if (order.seconds > 0.0) scene.duration = order.seconds;
  const FootballTeam first = FootballTeam::parse(order.first);
  const FootballTeam second = FootballTeam::parse(order.second);
  const std::string firstName = order.number % 2 == 0 ? "blue" : "yellow";
  for (PlayerWish& player : scene.players) {
    const FootballTeam& team = player.team == firstName ? first : second;
    if (player.plugin != kKeeper) {
      replace(player, team.player);
    } else if (team.keeper) {
      replace(player, *team.keeper);
    } else {
      if (team.player.plugin == kFrozen) replace(player, parsePlayer(frozenKeeper(order.league)));
      letSee(player, team, factory);
    }
  }
  return scene;
}

void FootballHalves::check(const Order& order) {
  for (const PlayerWish& wish : sceneOf(order, parts_->factory).players)
    parts_->factory.make<Player>(wish.plugin, wish.options);
}

FootballHalf FootballHalves::play(const Order& order, const Watch& watch) {
  const Scene scene = sceneOf(order, parts_->factory);
  std::vector<std::string> keepers;
  for (const PlayerWish& player : Scene::read(sceneFile(order.league)).players)
    if (player.plugin == kKeeper) keepers.push_back(player.name);
  Simulation::Config config;
  Random seeds(order.seed, order.number);
  config.seed = (std::uint64_t{seeds.next()} << 32) | seeds.next();
  std::string problem;
  PlayerControl::Config players;
  players.budget = 0.0;  // a limit of time would make halves differ
  players.onProblem = [&](const std::string& what) { problem = what; };
  players.tables = parts_->tables.at(order.league);
  SceneRun run(scene, config, parts_->factory, players);
  FootballWatch counts(run, order.number % 2 == 0 ? "blue" : "yellow", keepers);
  const Timestamp end = fromSeconds(scene.duration.value_or(600.0));
  while (problem.empty() && run.simulation().now() < end) {
    run.act();
    counts.compare();
    run.move();
    const std::vector<RefereeEvent> events =
        run.referee() == nullptr ? std::vector<RefereeEvent>() : run.referee()->takeEvents();
    counts.look(events);
    if (watch) watch(run, events);
  }
  if (!problem.empty())
    throw std::runtime_error("half " + std::to_string(order.number) + " of seed " +
                             std::to_string(order.seed) + " (" + order.league + "), '" +
                             order.first + "' against '" + order.second + "': " + problem);
  return counts.half();
}

}  // namespace ortung
