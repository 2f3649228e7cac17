#pragma once

#include <algorithm>
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
    Word word;
    RollingBall ball{{}, 0.0, 0.0, braking};
    int hasBall = 0;
    int end = 0;
    const int read =
        std::sscanf(text.c_str(), "fb %lf %lf %lf %d %lf %lf %lf %lf%n", &word.cost, &word.at.x,
                    &word.at.y, &hasBall, &ball.at.x, &ball.at.y, &ball.speedX, &ball.speedY, &end);
    if (read != 8 || text.size() != static_cast<std::size_t>(end)) return std::nullopt;
    constexpr double kMost = 1e4;  // NaN is not below
    for (const double number :
         {word.cost, word.at.x, word.at.y, ball.at.x, ball.at.y, ball.speedX, ball.speedY})
      if (!(std::abs(number) < kMost)) return std::nullopt;
    if (hasBall == 1) word.ball = ball;
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
