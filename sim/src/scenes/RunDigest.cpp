#include "ortung/sim/RunDigest.hpp"

#include <bit>

namespace ortung {

void RunDigest::number(double number) { word(std::bit_cast<std::uint64_t>(number)); }

void RunDigest::text(std::string_view text) {
  word(text.size());
  for (const char c : text) word(static_cast<unsigned char>(c));
}

void RunDigest::body(const Pose2& pose, const Twist& velocity) {
  number(pose.x), number(pose.y), number(pose.theta);
  number(velocity.x), number(velocity.y), number(velocity.theta);
}

void RunDigest::add(const SceneRun& run) {
  const Simulation& simulation = run.simulation();
  word(static_cast<std::uint64_t>(simulation.now()));
  for (const auto& robot : simulation.robots()) {
    const auto& state = robot->state();
    word(state.number);
    body(state.pose, state.velocity);
    for (const std::size_t manipulator : robot->manipulatorStates()) word(manipulator);
    for (const Message& message : simulation.readingsOf(state.number)) {
      word(static_cast<std::uint64_t>(message.stamp));
      word(message.words.size());
      for (const std::uint32_t one : message.words) word(one);
    }
  }
  for (const Simulation::Thing& thing : simulation.things()) body(thing.pose, thing.velocity);
  const Game& game = run.game();
  word(static_cast<std::uint64_t>(game.phase) << 32 | static_cast<std::uint64_t>(game.restart));
  for (const Game::Team& team : game.teams) word(static_cast<std::uint64_t>(team.score));
  number(game.clock);
}

void RunDigest::add(const RefereeEvent& event) {
  word(static_cast<std::uint64_t>(event.stamp));
  text(event.what), text(event.team), text(event.text);
}

}  // namespace ortung
