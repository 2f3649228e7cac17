#include "GameText.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace ortung::remote {
namespace {

/// Words "key=value" one after the other.
class Words {
 public:
  explicit Words(std::string_view text) : text_(text), rest_(text) {}

  bool isNext(std::string_view key) const {
    return rest_.starts_with(key) && rest_.substr(key.size()).starts_with('=');
  }
  std::pair<std::string_view, std::string_view> next() {
    const std::string_view word = rest_.substr(0, rest_.find(' '));
    rest_.remove_prefix(std::min(word.size() + 1, rest_.size()));
    const std::size_t is = word.find('=');
    if (is == word.npos || is == 0) fail();
    return {word.substr(0, is), word.substr(is + 1)};
  }
  std::string_view value(std::string_view key) {
    if (!isNext(key)) fail();
    return next().second;
  }
  template <class Number>
  Number number(std::string_view digits) const {
    Number number{};
    const char* end = digits.data() + digits.size();
    const auto [stop, error] = std::from_chars(digits.data(), end, number);
    if (error != std::errc() || stop != end) fail();
    return number;
  }
  [[noreturn]] void fail() const {
    throw std::runtime_error("the server says of the game '" + std::string(text_.substr(0, 200)) +
                             "', expected phase=, restart=, half=, clock_s=, two teams, left=");
  }

 private:
  std::string_view text_;
  std::string_view rest_;
};

}  // namespace

Game parseGame(std::string_view text) {
  Words words(text);
  Game game;
  const auto phase = phaseOf(words.value("phase"));
  const auto restart = restartOf(words.value("restart"));
  if (!phase || !restart) words.fail();
  game.phase = *phase;
  game.restart = *restart;
  const std::string_view taker = words.isNext("restart_of") ? words.next().second : "";
  game.half = words.number<int>(words.value("half"));
  game.clock = words.number<double>(words.value("clock_s"));
  for (Game::Team& team : game.teams) {
    const auto [name, score] = words.next();
    team.name = name;
    team.score = words.number<int>(score);
  }
  const auto left = game.find(words.value("left"));
  if (!left || !std::isfinite(game.clock)) words.fail();
  game.teamOnTheLeft = *left;
  if (!taker.empty() && !(game.restartOf = game.find(taker))) words.fail();
  return game;
}

}  // namespace ortung::remote
