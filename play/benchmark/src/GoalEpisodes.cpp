#include "ortung/benchmark/GoalEpisodes.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>

#include "PoseSums.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/benchmark/GoalMatrix.hpp"
#include "ortung/core/ShippedFiles.hpp"
#include "ortung/robot/RobotFile.hpp"
#include "ortung/sim/PlayerControl.hpp"
#include "ortung/sim/PlayerWish.hpp"
#include "ortung/sim/Simulation.hpp"

namespace ortung {
namespace {

constexpr double kKeeperLine = 0.5;   ///< distance of the keeper's line from the goal line [m]
constexpr double kKeeperReach = 0.7;  ///< greatest distance of its start from the middle [m]
/// Pose of the striker until it makes its situation.
constexpr Pose2 kStrikerWaits{3.0, 0.0, std::numbers::pi};

// Random streams of an episode's seed.
enum Stream : std::uint64_t { kSimulation, kPlacing, kOfKeeper, kOfStriker };

/// A player's request and robot, read once. They cache data, so each thread needs its own.
struct Entrant {
  PlayerWish wish;
  RobotConfig robot;
};

}  // namespace

struct GoalEpisodes::Parts {
  std::unique_ptr<SimWorld> world = readWorld(GoalEpisodes::world());
  std::string fingerprint = world->fingerprint();
  PluginFactory factory{PluginFactory::standardFolders()};
  std::map<std::string, Entrant> entrants;  ///< players by text and side
  std::shared_ptr<TableStore> tables;

  Entrant& entrant(const std::string& text, const char* team) {
    const std::string key = team + (" " + text);
    const auto known = entrants.find(key);
    if (known != entrants.end()) return known->second;
    PlayerWish wish = parsePlayer(text);
    if (!wish.team.empty() || !wish.name.empty() || wish.start)
      throw ConfigError("player '" + text +
                        "': the benchmark sets team, name and start, so they can't be given");
    const auto player = makeGoalPlayer(factory, wish);
    const auto file = wish.robot.empty() ? player->robotFile() : wish.robot;
    if (file.empty())
      throw ConfigError("player '" + text +
                        "' names no robot file, so one must be given "
                        "(robot=FILE)");
    RobotConfig robot = readRobot(shippedFile("robots", file));
    wish.team = wish.name = robot.name = team;
    return entrants.emplace(key, Entrant{std::move(wish), std::move(robot)}).first->second;
  }
};

GoalEpisodes::GoalEpisodes(std::shared_ptr<TableStore> tables) : parts_(std::make_unique<Parts>()) {
  parts_->tables = tables ? std::move(tables) : std::make_shared<TableStore>(world());
}
GoalEpisodes::~GoalEpisodes() = default;

std::filesystem::path GoalEpisodes::world() { return shippedFile("fields", "f2000.toml"); }

const std::string& GoalEpisodes::fingerprint() const { return parts_->fingerprint; }

void GoalEpisodes::check(const std::string& keeper, const std::string& striker) {
  parts_->entrant(keeper, "blue");
  parts_->entrant(striker, "yellow");
}

GoalEpisode GoalEpisodes::play(const std::string& keeper, const std::string& striker,
                               std::uint64_t seed, std::uint64_t number,
                               const std::function<void(const GoalMoment&)>& watch) {
  Entrant& keeps = parts_->entrant(keeper, "blue");
  Entrant& strikes = parts_->entrant(striker, "yellow");
  const auto stream = [&](Stream which) { return Random(seed, 4 * number + which); };
  Random simulationSeed = stream(kSimulation);
  Simulation::Config config;
  config.seed = (std::uint64_t{simulationSeed.next()} << 32) | simulationSeed.next();
  Simulation simulation(parts_->world->another(), config);
  FloorPlans plans(simulation.world());
  std::string problem;
  PlayerControl::Config players;
  players.budget = 0.0;  // a limit of time would make episodes differ
  players.onProblem = [&](const std::string& what) { problem = what; };
  players.tables = parts_->tables;
  PlayerControl control(simulation, plans, parts_->factory, players);

  Random placing = stream(kPlacing);
  const Pose2 stands{GoalField::kGoalX + kKeeperLine, placing.uniform(-kKeeperReach, kKeeperReach),
                     std::numbers::pi / 2.0};
  SimRobot& goalkeeper = simulation.addRobot(keeps.robot, parts_->factory, stands);
  SimRobot& attacker = simulation.addRobot(strikes.robot, parts_->factory, kStrikerWaits);
  control.own(goalkeeper, control.make(keeps.wish), keeps.wish, stream(kOfKeeper));
  control.own(attacker, control.make(strikes.wish), strikes.wish, stream(kOfStriker));

  GoalJudge judge;
  PoseErrors keeperErrors;
  PoseErrors strikerErrors;
  const Game game;
  const auto look = [&] {
    const GoalMoment moment{
        simulation.now(),      simulation.things().front().pose, goalkeeper.state().pose,
        attacker.state().pose, control.believedPose(goalkeeper), control.believedPose(attacker)};
    keeperErrors.add(moment.keeperBelieves, moment.keeper, moment.stamp);
    strikerErrors.add(moment.strikerBelieves, moment.striker, moment.stamp);
    if (watch) watch(moment);
  };
  while (problem.empty() && simulation.now() < kLongest) {
    simulation.sense();
    control.act(game);
    look();
    if (!problem.empty()) break;
    simulation.move();
    if (judge.sees(simulation.things().front(), goalkeeper, simulation.cycle())) break;
  }
  if (!problem.empty())
    throw std::runtime_error("episode " + std::to_string(number) + " of seed " +
                             std::to_string(seed) + ", '" + striker + "' against '" + keeper +
                             "': " + problem);
  if (watch) look();
  PoseDigest digest;
  digest.add(simulation.things().front().pose);
  digest.add(simulation.things().front().velocity);
  digest.add(goalkeeper.state().pose);
  digest.add(attacker.state().pose);
  return {judge.outcome(), simulation.now(), digest.value(), keeperErrors.mean(),
          strikerErrors.mean()};
}

}  // namespace ortung
