#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <deque>
#include <optional>

#include "ortung/base/Time.hpp"
#include "ortung/sim_api/World.hpp"

namespace ortung {

/// A ball that rolls straight on and is braked evenly by the floor.
struct RollingBall {
  FloorPoint at;         ///< [m]
  double speedX = 0.0;   ///< [m/s]
  double speedY = 0.0;   ///< [m/s]
  double braking = 0.0;  ///< of the floor [m/s^2]

  double speed() const { return std::hypot(speedX, speedY); }

  /// Where and when it comes over the line x = @p line; nothing if it goes elsewhere or stops
  /// before. After a way s it has the speed sqrt(v^2 - 2 b s).
  struct Crossing {
    double y = 0.0;      ///< [m]
    double after = 0.0;  ///< [s]
  };
  std::optional<Crossing> crossing(double line) const {
    const double ahead = line - at.x;
    if (ahead * speedX <= 0.0) return std::nullopt;
    const double way = ahead / speedX * speed();
    const double left = speed() * speed() - 2.0 * braking * way;
    if (left < 0.0) return std::nullopt;
    // = (v - sqrt(v^2 - 2 b s)) / b, without dividing by a braking of 0.
    return Crossing{at.y + ahead / speedX * speedY, 2.0 * way / (speed() + std::sqrt(left))};
  }

  /// Where it is some time later [s].
  FloorPoint later(double seconds) const {
    const double v = speed();
    if (v <= 0.0) return at;
    const double t = braking > 0.0 ? std::min(seconds, v / braking) : seconds;
    const double share = (v * t - 0.5 * braking * t * t) / v;
    return {at.x + share * speedX, at.y + share * speedY};
  }
};

/// What a keeper makes of the places where it has seen the ball: where it is and how it rolls, by
/// least squares over the newest ones. A kick or a bounce begins anew.
class BallTrack {
 public:
  /// How many places are enough where they are exact: the newest ones know best; and how many
  /// average out what noise there is.
  static constexpr std::size_t kMostExact = 8;
  static constexpr std::size_t kMostNoisy = 16;

  /// @param braking of the floor [m/s^2] @param sigma of where it is seen, as a rule [m]
  /// @param most newest places that are looked at
  explicit BallTrack(double braking, double sigma = 0.0, std::size_t most = kMostExact)
      : braking_(braking), sigma_(sigma), most_(most) {}

  void see(Timestamp stamp, const FloorPoint& at) { see(stamp, at, sigma_); }
  /// @param sigma of a coordinate of where it is seen, 0 if that is exact [m]
  void see(Timestamp stamp, const FloorPoint& at, double sigma) {
    if (!seen_.empty() && stamp <= seen_.back().stamp) return;
    if (seen_.size() >= 3) {
      const FloorPoint expected = ball_->later(toSeconds(stamp - seen_.back().stamp));
      const double off = std::hypot(at.x - expected.x, at.y - expected.y);
      surprises_ = off > kSurprise + 3.0 * sigma ? surprises_ + 1 : 0;
      // One alone may be an error of seeing.
      if (surprises_ >= 2) seen_.erase(seen_.begin(), seen_.end() - 1);
    }
    while (seen_.size() >= most_) seen_.pop_front();
    seen_.push_back({stamp, at, sigma > 0.0 ? 1.0 / (sigma * sigma) : 1.0});
    fit();
  }
  /// As it was when it was last seen; nothing before that.
  const std::optional<RollingBall>& ball() const { return ball_; }
  Timestamp lastSeen() const { return seen_.empty() ? 0 : seen_.back().stamp; }
  /// Whether its velocity is known.
  bool hasVelocity() const { return seen_.size() >= 2; }

 private:
  static constexpr double kSurprise = 0.05;  ///< farther from what was expected is elsewhere [m]

  struct Sight {
    Timestamp stamp = 0;
    FloorPoint at;
    double weight = 1.0;
  };

  /// A straight line through the places, once what the floor brakes is put back to them: before the
  /// newest one, at time t < 0, the ball was at p + v t - b t^2 / 2 along its way.
  void fit() {
    RollingBall ball{seen_.back().at, 0.0, 0.0, braking_};
    constexpr int kPasses = 3;  // the first one has no direction yet
    for (int pass = 0; pass < kPasses && seen_.size() >= 2; ++pass) line(ball);
    ball_ = ball;
  }
  void line(RollingBall& ball) const {
    const double v = ball.speed();
    const double brakingX = v > 0.0 ? braking_ * ball.speedX / v : 0.0;
    const double brakingY = v > 0.0 ? braking_ * ball.speedY / v : 0.0;
    double n = 0.0, t1 = 0.0, t2 = 0.0, x0 = 0.0, x1 = 0.0, y0 = 0.0, y1 = 0.0;
    for (const Sight& sight : seen_) {
      const double t = toSeconds(sight.stamp - seen_.back().stamp);
      const double x = sight.at.x + 0.5 * brakingX * t * t;
      const double y = sight.at.y + 0.5 * brakingY * t * t;
      const double w = sight.weight;
      n += w, t1 += w * t, t2 += w * t * t, x0 += w * x, x1 += w * x * t, y0 += w * y;
      y1 += w * y * t;
    }
    const double determinant = n * t2 - t1 * t1;
    if (determinant <= 0.0) return;
    ball.speedX = (n * x1 - t1 * x0) / determinant;
    ball.speedY = (n * y1 - t1 * y0) / determinant;
    ball.at = {(x0 * t2 - t1 * x1) / determinant, (y0 * t2 - t1 * y1) / determinant};
  }

  double braking_;
  double sigma_;
  std::size_t most_;
  int surprises_ = 0;
  std::deque<Sight> seen_;
  std::optional<RollingBall> ball_;
};

}  // namespace ortung
