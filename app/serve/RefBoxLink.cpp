#include "RefBoxLink.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "Console.hpp"
#include "HostPort.hpp"
#include "ortung/refbox/RefBoxClient.hpp"

namespace ortung::app {
namespace {

refbox::RefBoxConfig readConfig(const std::string& text) {
  refbox::RefBoxConfig config;
  std::string rest = text;
  const std::size_t at = rest.rfind('@');
  if (at != rest.npos) {
    config.ownTeam = rest.substr(at + 1);
    rest.resize(at);
  }
  const auto found = parseHostPort(rest);
  if (!found || found->port == 0)
    throw UsageError(fmt::format("--refbox is '{}', expected HOST[:PORT][@TEAM]", text));
  config.host = found->host;
  config.port = found->port.value_or(config.port);
  return config;
}

/// Returns the world state of a team with perfect perception.
refbox::WorldState stateOf(SceneRun& run, const std::string& team) {
  refbox::WorldState state;
  state.teamName = team;
  for (const StagedRobot& robot : run.players().stage().robots()) {
    if (robot.team != team) continue;
    refbox::WorldState::Robot one;
    one.id = static_cast<int>(state.robots.size()) + 1;
    one.pose = one.targetPose = robot.pose;
    one.velocity = robot.velocity;
    state.robots.push_back(one);
  }
  for (const Simulation::Thing& thing : run.simulation().things())
    if (thing.kind == "ball")
      state.balls.push_back(
          {{thing.pose.x, thing.pose.y, 0.0}, {thing.velocity.x, thing.velocity.y, 0.0}, 1.0});
  return state;
}

}  // namespace

RefBoxLink::RefBoxLink(const std::string& text, const Run& run) {
  if (run().referee() == nullptr)
    throw UsageError("--refbox: there is no referee; see --referee soccer:control=orders");
  refbox::RefBoxConfig config = readConfig(text);
  const Game& game = run().referee()->watch(run().players().stage());
  const auto own = game.find(config.ownTeam);
  if (!own)
    throw UsageError(fmt::format("--refbox is '{}', its team is '{}', expected {} or {}", text,
                                 config.ownTeam, game.teams[0].name, game.teams[1].name));
  config.otherTeam = game.teams.at(1 - *own).name;
  try {
    client_ = std::make_unique<refbox::RefBoxClient>(
        config, [run, team = config.ownTeam] { return stateOf(run(), team); },
        [run](const std::string& order) {
          if (run().referee() != nullptr) run().referee()->order(order);
        },
        [](const std::string& line) { note("refbox: " + line); });
  } catch (const std::invalid_argument& error) {
    throw UsageError(fmt::format("--refbox is '{}': {}", text, error.what()));
  }
}

RefBoxLink::~RefBoxLink() = default;

void RefBoxLink::poll(double seconds) { client_->poll(seconds); }

}  // namespace ortung::app
