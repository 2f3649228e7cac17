#pragma once

// FROZEN, a part of the team footballer-v1: docs/matches.md tells why. Never changed; improvements
// are made in the players of today.

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>
#include <string>

#include "View.hpp"
#include "ortung/sim_api/Player.hpp"

namespace ortung::football_v1 {

/// The message of a footballer to its team: "fb COST X Y BALL X Y VX VY", where BALL is 1 if it has
/// seen the ball.
struct Word {
  double cost = 0.0;                ///< time until it has the ball [s]
  FloorPoint at;                    ///< the sender's place [m]
  std::optional<RollingBall> ball;  ///< the ball as the sender has seen it itself

  std::string text() const {
    const RollingBall told = ball.value_or(RollingBall{});
    char words[160];
    std::snprintf(words, sizeof words, "fb %.3f %.3f %.3f %d %.3f %.3f %.3f %.3f", cost, at.x, at.y,
                  ball ? 1 : 0, told.at.x, told.at.y, told.speedX, told.speedY);
    return words;
  }
  /// Reads a message; nothing if it is of another kind or malformed.
  static std::optional<Word> parse(const std::string& text, double braking) {
    if (!text.starts_with("fb")) return std::nullopt;
    std::array<double, 8> numbers{};
    const char* at = text.data() + 2;
    const char* const end = text.data() + text.size();
    for (double& number : numbers) {
      if (at == end || *at++ != ' ') return std::nullopt;
      const auto [stop, error] = std::from_chars(at, end, number);
      constexpr double kMost = 1e4;  // also refuses NaN
      if (error != std::errc() || !(std::abs(number) < kMost)) return std::nullopt;
      at = stop;
    }
    if (at != end) return std::nullopt;
    Word word{numbers[0], {numbers[1], numbers[2]}, std::nullopt};
    if (numbers[3] == 1.0)
      word.ball = RollingBall{{numbers[4], numbers[5]}, numbers[6], numbers[7], braking};
    return word;
  }
};

/// The recent messages of each mate.
class Mates {
 public:
  struct Told {
    Word word;
    Timestamp stamp = 0;
  };

  explicit Mates(double braking) : braking_(braking) {}

  void hear(std::span<const Heard> heard, Timestamp now) {
    for (const Heard& one : heard)
      if (const auto word = Word::parse(one.text, braking_))
        if (told_.size() < kMost || told_.contains(one.from)) told_[one.from] = {*word, one.stamp};
    std::erase_if(told_, [&](const auto& one) {
      return now - one.second.stamp > kForgotten || one.second.stamp > now + kForgotten;
    });
  }
  const std::map<std::string, Told>& told() const { return told_; }

 private:
  /// Age from which a message is forgotten [us].
  static constexpr Timestamp kForgotten = 1'000'000;
  static constexpr std::size_t kMost = 32;
  double braking_;
  std::map<std::string, Told> told_;
};

}  // namespace ortung::football_v1
