#include "ortung/sim/SceneRun.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "PrimitiveFile.hpp"
#include "ortung/core/PluginGuard.hpp"
#include "ortung/core/ShippedFiles.hpp"
#include "ortung/sim_api/PlayerGuard.hpp"

namespace ortung {
namespace {

constexpr int kAttempts = 200;       // number of attempts to find room on a crowded field
constexpr double kLook = 0.05;       // step of the test along the path to a waypoint [m]
constexpr double kMostLooks = 4000;  // greatest number of tests on a path

/// Returns the request for a player that drives one of the scene's robots.
PlayerWish wishOf(const char* plugin, const std::string& robot, std::optional<double> speed) {
  PlayerWish wish;
  wish.plugin = plugin;
  wish.options = Parameters("robot " + robot);
  if (speed) wish.options.set("speed_m_s", *speed);
  return wish;
}

PlayerWish followWish(const SceneRobot& robot) {
  PlayerWish wish = wishOf("follow", robot.name, robot.speed);
  std::vector<double> numbers;
  for (const FloorPoint& point : robot.waypoints) numbers.insert(numbers.end(), {point.x, point.y});
  wish.options.set("waypoints_m", numbers);
  return wish;
}

/// Calls action(pose) at random poses on the robot's floor until there is room. @throws NoRoom if
/// no room is found
template <class Action>
decltype(auto) anywhere(const RoutePlanner& floor, Random& placing, const std::string& robot,
                        const Action& action) {
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    try {
      return action(floor.randomPose(placing));
    } catch (const NoRoom&) {  // another pose is tried
    }
  }
  throw NoRoom("found no room for robot " + robot + " at " + std::to_string(kAttempts) + " places");
}

/// Checks the waypoints of a robot. It goes straight from one to the next, so the whole path must
/// be free of fixed obstacles. @throws std::invalid_argument
void checkWaypoints(const SimWorld& world, const SimRobot& robot, const SceneRobot& wanted) {
  const RobotSize size = sizeOf(robot.config());
  FloorPoint from{robot.state().pose.x, robot.state().pose.y};
  for (std::size_t i = 0; i < wanted.waypoints.size(); ++i) {
    const FloorPoint& to = wanted.waypoints[i];
    const std::string what = "robot " + wanted.name + ": waypoint " + std::to_string(i + 1) +
                             " at (" + std::to_string(to.x) + ", " + std::to_string(to.y) + ") ";
    if (!world.isFree(to.x, to.y, size))
      throw std::invalid_argument(what + "has no room for a radius of " +
                                  std::to_string(size.radius) + " m");
    const double way = std::hypot(to.x - from.x, to.y - from.y);
    const double step = std::max(kLook, way / kMostLooks);
    // A kidnapped robot comes from anywhere.
    for (double done = step; done < way && wanted.kidnaps.empty(); done += step) {
      const double x = from.x + done / way * (to.x - from.x);
      const double y = from.y + done / way * (to.y - from.y);
      if (!world.isFree(x, y, size))
        throw std::invalid_argument(what +
                                    "can't be reached: going straight there, it is stopped at (" +
                                    std::to_string(x) + ", " + std::to_string(y) + ")");
    }
    from = to;
  }
}

/// Adds a table store for the scene's world, for players that localize themselves.
PlayerControl::Config withTables(PlayerControl::Config players,
                                 const std::filesystem::path& world) {
  if (!players.tables) players.tables = std::make_shared<TableStore>(world);
  return players;
}

}  // namespace

SceneRun::SceneRun(const Scene& scene, const Simulation::Config& config, PluginFactory& factory,
                   const PlayerControl::Config& players)
    : scene_(scene),
      simulation_(std::make_unique<Simulation>(readWorld(scene.world), config)),
      factory_(factory),
      plans_(std::make_unique<FloorPlans>(simulation_->world())),
      playerConfig_(withTables(players, scene.world)),
      players_(std::make_unique<PlayerControl>(*simulation_, *plans_, factory, playerConfig_)) {
  if (scene_.referee)
    referee_ = factory.make<Referee>(scene_.referee->plugin, scene_.referee->options);
  // Robots with a given start come first, so that no other robot is there already.
  for (const bool hasStart : {true, false})
    for (std::size_t i = 0; i < scene_.robots.size(); ++i)
      if (scene_.robots[i].start.has_value() == hasStart) addRobot(scene_.robots[i], i, factory);
  for (std::size_t i = 0; i < scene_.players.size(); ++i)
    addPlayer(scene_.players[i], scene_.robots.size() + i);
  for (const SceneCommand& command : scene_.commands) check(command);
  for (const ScenePlacement& placement : scene_.placements) needThing(placement.thing);
}

SceneRun::~SceneRun() = default;

void SceneRun::addRobot(const SceneRobot& robot, std::size_t place, PluginFactory& factory) {
  RobotConfig config = readRobot(robot.file);
  config.name = robot.name;
  Random placing = simulation_->random(2 * place);
  SimRobot& added = enter(config, factory, robot.start, placing);
  if (robot.wanders) letWander(added, place, robot.speed);
  checkWaypoints(simulation_->world(), added, robot);
  if (!robot.waypoints.empty())
    players_->lead(added, followWish(robot), simulation_->random(2 * place + 1));
  if (!robot.kidnaps.empty()) kidnapped_.push_back({added, robot.kidnaps, placing});
}

SimRobot& SceneRun::addRobot(const RobotConfig& config, PluginFactory& factory,
                             const std::optional<Pose2>& start, std::uint64_t number) {
  Random placing = simulation_->random(2 * number);
  return enter(config, factory, start, placing);
}

SimRobot& SceneRun::enter(const RobotConfig& config, PluginFactory& factory,
                          const std::optional<Pose2>& start, Random& placing) {
  const auto add = [&](const Pose2& pose) -> SimRobot& {
    return simulation_->addRobot(config, factory, pose);
  };
  return start ? add(*start) : anywhere(*plans_->of(sizeOf(config)), placing, config.name, add);
}

void SceneRun::kidnap(Kidnapped& kidnapped) {
  if (kidnapped.next == kidnapped.moments.size() ||
      simulation_->now() < kidnapped.moments[kidnapped.next])
    return;
  ++kidnapped.next;
  const RobotConfig& config = kidnapped.robot.config();
  anywhere(*plans_->of(sizeOf(config)), kidnapped.placing, config.name,
           [&](const Pose2& pose) { simulation_->place(kidnapped.robot, pose); });
}

void SceneRun::letWander(SimRobot& robot, std::uint64_t number, std::optional<double> speed) {
  players_->lead(robot, wishOf("wander", robot.config().name, speed),
                 simulation_->random(2 * number + 1));
}

SimRobot& SceneRun::addPlayer(const PlayerWish& wish, std::uint64_t number) {
  std::unique_ptr<Player> player = players_->make(wish);
  const std::filesystem::path file =
      wish.robot.empty() ? needsOf(*player, wish.plugin).robotFile : wish.robot;
  if (file.empty())
    throw std::invalid_argument("the player '" + wish.plugin +
                                "' names no robot file, so one must be given (robot=FILE)");
  RobotConfig config = readRobot(shippedFile("robots", file));
  if (!wish.name.empty() && !isWord(wish.name))
    throw std::invalid_argument("the player '" + wish.plugin + "': the name of its robot is '" +
                                wish.name + "', expected [A-Za-z0-9_-]{1,64}");
  if (!wish.name.empty()) config.name = wish.name;
  const std::string name = config.name;
  for (int i = 2; wish.name.empty() && find(config.name); ++i)
    config.name = name + "-" + std::to_string(i);
  SimRobot& robot = addRobot(config, factory_, wish.start, number);
  try {
    players_->own(robot, std::move(player), wish, simulation_->random(2 * number + 1));
  } catch (...) {  // a robot without its player is removed
    simulation_->removeRobot(robot);
    throw;
  }
  return robot;
}

std::optional<std::size_t> SceneRun::find(const std::string& robot) const {
  const auto robots = simulation_->robots();
  const auto found = std::find_if(robots.begin(), robots.end(),
                                  [&](const auto& one) { return one->config().name == robot; });
  if (found == robots.end()) return std::nullopt;
  return static_cast<std::size_t>(found - robots.begin());
}

std::size_t SceneRun::need(const std::string& robot) const {
  const auto found = find(robot);
  if (!found)
    throw std::invalid_argument("a command is for robot '" + robot + "', which is not there");
  return *found;
}

/// Checks a command before the run, so that a bad one does not end the run in the middle.
void SceneRun::check(const SceneCommand& command) const {
  const SimRobot& robot = *simulation_->robots()[need(command.robot)];
  if (!command.manipulator.empty()) robot.findManipulator(command.manipulator, command.state);
  const std::size_t expected = robot.drive().commandSize();
  if (!command.vector.empty() && command.vector.size() != expected)
    throw std::invalid_argument("robot " + command.robot + ": the command at " +
                                std::to_string(toSeconds(command.at)) + " s has " +
                                std::to_string(command.vector.size()) + " numbers, expected " +
                                std::to_string(expected) + ": " + robot.drive().commandHelp());
}

std::size_t SceneRun::needThing(const std::string& thing) const {
  const auto things = simulation_->things();
  for (std::size_t i = 0; i < things.size(); ++i)
    if (things[i].name == thing) return i;
  throw std::invalid_argument("the world has no movable thing named '" + thing + "'");
}

void SceneRun::step() {
  act();
  move();
}

void SceneRun::act() {
  const Timestamp now = simulation_->now();
  while (nextPlacement_ < scene_.placements.size() && scene_.placements[nextPlacement_].at <= now)
    put(scene_.placements[nextPlacement_++]);
  while (nextCommand_ < scene_.commands.size() && scene_.commands[nextCommand_].at <= now)
    obey(scene_.commands[nextCommand_++]);
  for (Kidnapped& kidnapped : kidnapped_) kidnap(kidnapped);
  players_->deliver();
  simulation_->sense();
  watch();
  players_->act(game_);
}

void SceneRun::move() {
  simulation_->move();
  players_->clear();
}

/// Lets the referee observe the world. A referee that fails is removed, and the game goes on
/// without one.
void SceneRun::watch() {
  if (!referee_) return;
  std::string why;
  try {
    game_ = referee_->watch(players_->stage());
    for (const auto& robot : simulation_->robots())
      robot->hold(referee_->holds(robot->config().name));
    return;
  } catch (const std::exception& error) {
    why = error.what();
  } catch (...) {
    why = "it threw no std::exception";
  }
  if (playerConfig_.onProblem)
    playerConfig_.onProblem("at " + std::to_string(toSeconds(simulation_->now())) +
                            " s: the referee '" + scene_.referee->plugin + "': " + why +
                            "; the game goes on without it");
  referee_.reset();
  game_ = {};
  for (const auto& robot : simulation_->robots()) robot->hold(false);
}

void SceneRun::put(const ScenePlacement& placement) {
  simulation_->placeThing(needThing(placement.thing), placement.pose, placement.velocity);
}

void SceneRun::obey(const SceneCommand& command) {
  const auto place = find(command.robot);
  if (!place) return;  // its player has ended and it has left
  SimRobot& robot = *simulation_->robots()[*place];
  try {
    if (command.translational) robot.setTranslationalVelocity(*command.translational);
    if (command.rotational) robot.setRotationalVelocity(*command.rotational);
    if (!command.vector.empty()) robot.setMotion(command.vector);
  } catch (const PluginFailure&) {
    // Its drive is switched off, which problems() reports; the other robots go on.
  }
  if (!command.manipulator.empty()) robot.setManipulator(command.manipulator, command.state);
}

}  // namespace ortung
