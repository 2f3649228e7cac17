#pragma once

// FROZEN, a part of the team footballer-v1: docs/matches.md tells why. Never changed; improvements
// are made in the players of today.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <deque>
#include <optional>

#include "ortung/base/Time.hpp"
#include "ortung/sim_api/World.hpp"

namespace ortung {

/// A ball that rolls straight and is decelerated uniformly by the floor.
struct RollingBall {
  FloorPoint at;         ///< position in the field frame [m]
  double speedX = 0.0;   ///< velocity along x [m/s]
  double speedY = 0.0;   ///< velocity along y [m/s]
  double braking = 0.0;  ///< deceleration by the floor [m/s^2]
  double speed() const { return std::hypot(speedX, speedY); }

  /// Place and time at which it crosses the line x = @p line; nothing if it moves elsewhere or
  /// stops before. After a distance s it has the speed sqrt(v^2 - 2 b s).
  struct Crossing {
    double y = 0.0;      ///< y of the crossing [m]
    double after = 0.0;  ///< time until the crossing [s]
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

  /// Returns its position after a time [s].
  FloorPoint later(double seconds) const {
    const double v = speed();
    if (v <= 0.0) return at;
    const double t = braking > 0.0 ? std::min(seconds, v / braking) : seconds;
    const double share = (v * t - 0.5 * braking * t * t) / v;
    return {at.x + share * speedX, at.y + share * speedY};
  }
};

/// A track of the ball from sightings: its position and velocity by least squares over the newest
/// ones. A kick or a bounce starts a new track.
class BallTrack {
 public:
  /// The number of sightings used if they are exact, when the newest ones are best, and if they are
  /// noisy, when more of them average the noise.
  static constexpr std::size_t kMostExact = 8;
  static constexpr std::size_t kMostNoisy = 16;

  /// @param braking deceleration by the floor [m/s^2]
  /// @param sigma default standard deviation of a sighting [m]
  /// @param most number of newest sightings that are used
  explicit BallTrack(double braking, double sigma = 0.0, std::size_t most = kMostExact)
      : braking_(braking), sigma_(sigma), most_(most) {}

  void see(Timestamp stamp, const FloorPoint& at) { see(stamp, at, sigma_); }
  /// Adds a sighting. @param sigma standard deviation of a coordinate [m], 0: exact
  void see(Timestamp stamp, const FloorPoint& at, double sigma) {
    if (!seen_.empty() && stamp <= seen_.back().stamp) return;
    if (seen_.size() >= 3) {
      const FloorPoint expected = ball_->later(toSeconds(stamp - seen_.back().stamp));
      const double off = std::hypot(at.x - expected.x, at.y - expected.y);
      surprises_ = off > kSurprise + 3.0 * sigma ? surprises_ + 1 : 0;
      // A single one may be an error of the sensor.
      if (surprises_ >= 2) seen_.erase(seen_.begin(), seen_.end() - 1);
    }
    while (seen_.size() >= most_) seen_.pop_front();
    seen_.push_back({stamp, at, sigma > 0.0 ? 1.0 / (sigma * sigma) : 1.0});
    fit();
  }
  /// Returns the ball at the time of the last sighting; nothing before the first one.
  const std::optional<RollingBall>& ball() const { return ball_; }
  Timestamp lastSeen() const { return seen_.empty() ? 0 : seen_.back().stamp; }
  /// Returns whether its velocity is known.
  bool hasVelocity() const { return seen_.size() >= 2; }

 private:
  /// Innovation beyond which a sighting contradicts the track [m].
  static constexpr double kSurprise = 0.05;

  struct Sight {
    Timestamp stamp = 0;
    FloorPoint at;
    double weight = 1.0;
  };

  /// Fits a straight line to the sightings after the deceleration is compensated: at time t < 0,
  /// before the newest one, the ball was at p + v t - b t^2 / 2 along its path.
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
