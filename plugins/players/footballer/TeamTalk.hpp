#pragma once

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

namespace ortung::football {

/// What footballers of a team tell each other: "fb COST X Y BALL X Y VX VY", where BALL is 1 if it
/// has seen the ball.
struct Word {
  double cost = 0.0;                ///< until it has the ball [s]
  FloorPoint at;                    ///< its own place [m]
  std::optional<RollingBall> ball;  ///< that it has seen itself

  std::string text() const {
    const RollingBall told = ball.value_or(RollingBall{});
    char words[160];
    std::snprintf(words, sizeof words, "fb %.3f %.3f %.3f %d %.3f %.3f %.3f %.3f", cost, at.x, at.y,
                  ball ? 1 : 0, told.at.x, told.at.y, told.speedX, told.speedY);
    return words;
  }
  /// Nothing if it is something else, or nonsense.
  static std::optional<Word> parse(const std::string& text, double braking) {
    if (!text.starts_with("fb")) return std::nullopt;
    std::array<double, 8> numbers{};
    const char* at = text.data() + 2;
    const char* const end = text.data() + text.size();
    for (double& number : numbers) {
      if (at == end || *at++ != ' ') return std::nullopt;
      const auto [stop, error] = std::from_chars(at, end, number);
      constexpr double kMost = 1e4;  // NaN is not below
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

/// What was heard lately of each mate.
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
  static constexpr Timestamp kForgotten = 1'000'000;  ///< [us]
  static constexpr std::size_t kMost = 32;
  double braking_;
  std::map<std::string, Told> told_;
};

}  // namespace ortung::football
