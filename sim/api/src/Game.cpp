#include "ortung/sim_api/Game.hpp"

#include <algorithm>
#include <span>

namespace ortung {
namespace {

constexpr std::array<std::string_view, 5> kPhases = {"free", "stopped", "ready", "playing", "over"};
constexpr std::array<std::string_view, 8> kRestarts = {
    "none", "kick-off", "throw-in", "goal-kick", "corner", "free-kick", "penalty", "dropped-ball"};

/// Place of a name in a table.
std::optional<std::size_t> placeOf(std::string_view name, std::span<const std::string_view> names) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return std::nullopt;
  return static_cast<std::size_t>(found - names.begin());
}

}  // namespace

std::optional<std::size_t> Game::find(std::string_view team) const {
  for (std::size_t i = 0; i < teams.size(); ++i)
    if (teams[i].name == team) return i;
  return std::nullopt;
}

double Game::directionOf(std::string_view team) const {
  const auto place = find(team);
  return place && *place != teamOnTheLeft ? -1.0 : 1.0;
}

bool Game::mayPlay(std::string_view team) const {
  if (phase == Phase::kFree || phase == Phase::kPlaying) return true;
  return phase == Phase::kReady && restartOf && find(team) == restartOf;
}

std::string_view nameOf(Game::Phase phase) { return kPhases.at(static_cast<std::size_t>(phase)); }

std::string_view nameOf(Game::Restart restart) {
  return kRestarts.at(static_cast<std::size_t>(restart));
}

std::optional<Game::Phase> phaseOf(std::string_view name) {
  const auto place = placeOf(name, kPhases);
  if (!place) return std::nullopt;
  return static_cast<Game::Phase>(*place);
}

std::optional<Game::Restart> restartOf(std::string_view name) {
  const auto place = placeOf(name, kRestarts);
  if (!place) return std::nullopt;
  return static_cast<Game::Restart>(*place);
}

}  // namespace ortung
