#include "ortung/benchmark/GoalEpisodes.hpp"

#include <bit>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>

#include "ortung/base/Random.hpp"
#include "ortung/core/ShippedFiles.hpp"
#include "ortung/robot/RobotFile.hpp"
#include "ortung/sim/PlayerControl.hpp"
#include "ortung/sim/PlayerWish.hpp"
#include "ortung/sim/Simulation.hpp"

namespace ortung {
namespace {

// The F2000 field: the goal at negative x, 2 m wide, and what lies round the field.
constexpr double kGoalX = -6.0;
constexpr double kHalfMouth = 1.0;
constexpr double kHalfLength = 6.0;
constexpr double kHalfWidth = 4.0;
constexpr double kBall = 0.11;  ///< radius [m]

constexpr double kKeeperLine = 0.5;   ///< before the goal line [m]
constexpr double kKeeperReach = 0.7;  ///< it begins within so far of the middle [m]
constexpr Pose2 kStrikerWaits{3.0, 0.0, std::numbers::pi};  ///< until it makes its situation

constexpr double kShot = 1.0;    ///< faster towards the goal the ball was shot [m/s]
constexpr double kBack = 0.2;    ///< away from the goal it comes back [m/s]
constexpr double kRest = 0.05;   ///< [m/s]
constexpr double kTouch = 0.02;  ///< nearer than this to the keeper the ball touches it [m]

// Streams of an episode's seed.
enum Stream : std::uint64_t { kSimulation, kPlacing, kOfKeeper, kOfStriker };

/// One player's wish and robot, read once: what they remember is not for several threads.
struct Entrant {
  PlayerWish wish;
  RobotConfig robot;
};

class Digest {
 public:
  void add(double value) {
    const auto bits = std::bit_cast<std::uint64_t>(value);
    for (int i = 0; i < 64; i += 8) hash_ = (hash_ ^ ((bits >> i) & 0xff)) * 1099511628211U;
  }
  void add(const Pose2& pose) { add(pose.x), add(pose.y), add(pose.theta); }
  void add(const Twist& twist) { add(twist.x), add(twist.y), add(twist.theta); }
  std::uint32_t value() const { return static_cast<std::uint32_t>(hash_ ^ (hash_ >> 32)); }

 private:
  std::uint64_t hash_ = 14695981039346656037U;
};

/// By the circle around the keeper; nothing else that deflects a ball is as near.
bool touches(const SimRobot& keeper, const Simulation::Thing& ball) {
  return distance(keeper.state().pose, ball.pose) < keeper.config().radius + kBall + kTouch;
}

/// Follows one ball until its chance is over.
class Judge {
 public:
  /// Whether it is over, and how.
  bool sees(const Simulation::Thing& ball, const SimRobot& keeper) {
    const double towards = -ball.velocity.x;
    wasShot_ = wasShot_ || towards > kShot;
    wasTouched_ = wasTouched_ || (wasShot_ && touches(keeper, ball));
    if (ball.pose.x < kGoalX - kBall) {
      outcome = std::abs(ball.pose.y) < kHalfMouth ? GoalOutcome::goal : missed();
      return true;
    }
    const bool isOff =
        ball.pose.x > kHalfLength + kBall || std::abs(ball.pose.y) > kHalfWidth + kBall;
    const bool isBack =
        wasShot_ && (towards < -kBack || std::hypot(ball.velocity.x, ball.velocity.y) < kRest);
    if (isOff || isBack) outcome = missed();
    return isOff || isBack;
  }
  GoalOutcome outcome = GoalOutcome::time;

 private:
  GoalOutcome missed() const { return wasTouched_ ? GoalOutcome::saved : GoalOutcome::out; }
  bool wasShot_ = false;
  bool wasTouched_ = false;
};

}  // namespace

struct GoalEpisodes::Parts {
  std::unique_ptr<SimWorld> world = readWorld(shippedFile("fields", "f2000.toml"));
  std::string fingerprint = world->fingerprint();
  PluginFactory factory{PluginFactory::standardFolders()};
  std::map<std::string, Entrant> entrants;  ///< by text and side

  Entrant& entrant(const std::string& text, const char* team) {
    const std::string key = team + (" " + text);
    const auto known = entrants.find(key);
    if (known != entrants.end()) return known->second;
    PlayerWish wish = parsePlayer(text);
    if (!wish.team.empty() || !wish.name.empty() || wish.start)
      throw ConfigError("player '" + text +
                        "': a benchmark gives team, name and start, so it can't say them");
    const auto player = factory.make<Player>(wish.plugin, wish.options);
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

GoalEpisodes::GoalEpisodes() : parts_(std::make_unique<Parts>()) {}
GoalEpisodes::~GoalEpisodes() = default;

const std::string& GoalEpisodes::fingerprint() const { return parts_->fingerprint; }

void GoalEpisodes::check(const std::string& keeper, const std::string& striker) {
  parts_->entrant(keeper, "blue");
  parts_->entrant(striker, "yellow");
}

GoalEpisode GoalEpisodes::play(const std::string& keeper, const std::string& striker,
                               std::uint64_t seed, std::uint64_t number) {
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
  players.budget = 0.0;  // a clock would make episodes differ
  players.onProblem = [&](const std::string& what) { problem = what; };
  PlayerControl control(simulation, plans, parts_->factory, players);

  Random placing = stream(kPlacing);
  const Pose2 stands{kGoalX + kKeeperLine, placing.uniform(-kKeeperReach, kKeeperReach),
                     std::numbers::pi / 2.0};
  SimRobot& goalkeeper = simulation.addRobot(keeps.robot, parts_->factory, stands);
  SimRobot& attacker = simulation.addRobot(strikes.robot, parts_->factory, kStrikerWaits);
  control.own(goalkeeper, control.make(keeps.wish), keeps.wish, stream(kOfKeeper));
  control.own(attacker, control.make(strikes.wish), strikes.wish, stream(kOfStriker));

  Judge judge;
  const Game game;
  while (problem.empty() && simulation.now() < kLongest) {
    simulation.sense();
    control.act(game);
    if (!problem.empty()) break;
    simulation.move();
    if (judge.sees(simulation.things().front(), goalkeeper)) break;
  }
  if (!problem.empty())
    throw std::runtime_error("episode " + std::to_string(number) + " of seed " +
                             std::to_string(seed) + ", '" + striker + "' against '" + keeper +
                             "': " + problem);
  Digest digest;
  digest.add(simulation.things().front().pose);
  digest.add(simulation.things().front().velocity);
  digest.add(goalkeeper.state().pose);
  digest.add(attacker.state().pose);
  return {judge.outcome, simulation.now(), digest.value()};
}

}  // namespace ortung
