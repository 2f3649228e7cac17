#include "ortung/sim_api/Game.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

namespace ortung {
namespace {

constexpr std::array<std::string_view, 5> kPhases = {"free", "stopped", "ready", "playing", "over"};
constexpr std::array<std::string_view, 8> kRestarts = {
    "none", "kick-off", "throw-in", "goal-kick", "corner", "free-kick", "penalty", "dropped-ball"};

/// Returns the index of a name in a table.
std::optional<std::size_t> placeOf(std::string_view name, std::span<const std::string_view> names) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return std::nullopt;
  return static_cast<std::size_t>(found - names.begin());
}

/// Returns the shortest text that is read as this number again.
std::string shortest(double number) {
  char text[32];
  const auto [end, error] = std::to_chars(text, text + sizeof text, number);
  return {text, end};
}

using Keys = std::vector<std::pair<std::string_view, std::string_view>>;

[[noreturn]] void failOn(std::string_view text) {
  throw std::invalid_argument("found '" + std::string(text.substr(0, 200)) +
                              "', expected the state of a game, e.g. 'phase=ready restart=kick-off "
                              "half=1 clock_s=12.5 blue=0 yellow=1 left=blue'");
}

Keys keysIn(std::string_view text) {
  constexpr std::size_t kMost = 20;
  Keys keys;
  std::string_view rest = text;
  while (!rest.empty()) {
    const std::string_view word = rest.substr(0, rest.find(' '));
    rest.remove_prefix(std::min(word.size() + 1, rest.size()));
    const std::size_t equals = word.find('=');
    if (equals == word.npos || equals == 0 || keys.size() == kMost) failOn(text);
    keys.emplace_back(word.substr(0, equals), word.substr(equals + 1));
  }
  return keys;
}

template <class Number>
Number numberIn(std::string_view value, std::string_view text) {
  Number number{};
  const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
  if (error != std::errc() || end != value.data() + value.size()) failOn(text);
  if constexpr (std::is_floating_point_v<Number>)
    if (!std::isfinite(number)) failOn(text);
  return number;
}

template <class Value>
Value valueIn(const std::optional<Value>& value, std::string_view text) {
  if (!value) failOn(text);
  return *value;
}

}  // namespace

std::string toText(const Game& game) {
  std::string text =
      "phase=" + std::string(nameOf(game.phase)) + " restart=" + std::string(nameOf(game.restart));
  if (game.restartOf) text += " restart_of=" + game.teams.at(*game.restartOf).name;
  text += " half=" + std::to_string(game.half) + " clock_s=" + shortest(game.clock);
  for (const Game::Team& team : game.teams)
    text += " " + team.name + "=" + std::to_string(team.score);
  return text + " left=" + game.teams.at(game.teamOnTheLeft).name;
}

Game gameIn(std::string_view text) {
  Game game;
  std::size_t teams = 0;
  std::string_view of;
  std::string_view left;
  bool hasPhase = false;
  for (const auto& [key, value] : keysIn(text)) {
    if (key == "phase") {
      game.phase = valueIn(phaseOf(value), text);
      hasPhase = true;
    } else if (key == "restart") {
      game.restart = valueIn(restartOf(value), text);
    } else if (key == "restart_of") {
      of = value;
    } else if (key == "half") {
      game.half = numberIn<int>(value, text);
    } else if (key == "clock_s") {
      game.clock = numberIn<double>(value, text);
    } else if (key == "left") {
      left = value;
    } else if (teams < game.teams.size()) {  // any other key is the name of a team
      game.teams.at(teams++) = {std::string(key), numberIn<int>(value, text)};
    } else {
      failOn(text);
    }
  }
  if (!hasPhase || teams != game.teams.size()) failOn(text);
  game.teamOnTheLeft = valueIn(game.find(left), text);
  if (!of.empty()) game.restartOf = valueIn(game.find(of), text);
  return game;
}

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
