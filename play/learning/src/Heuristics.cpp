#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "Observation.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/learning/Environments.hpp"

namespace ortung::learning {
namespace {

constexpr double kLine = 0.5;          ///< distance of a keeper's line from the goal line [m]
constexpr double kReach = 0.75;        ///< how far it goes to either side of the goal's middle [m]
constexpr double kKeeperSpeed = 1.5;   ///< speed of an action of 1 [m/s]
constexpr double kAcceleration = 3.5;  ///< the keeper's acceleration [m/s^2]
constexpr double kKnown = 1.0;         ///< age from which a sight counts as never seen [s]

struct Place {
  double x = 0.0;  ///< [m]
  double y = 0.0;
  double age = 0.0;  ///< [s]
};

class Look {
 public:
  explicit Look(std::span<const float> o) : o_(o) {}
  double at(std::size_t place) const { return static_cast<double>(o_[place]); }
  double heading() const { return std::atan2(at(kSin), at(kCos)); }
  Place seen(std::size_t first) const { return {at(first), at(first + 1), at(first + 2)}; }
  Place ball(std::size_t i) const { return seen(kBall + 3 * i); }
  Place other() const { return seen(kOther); }

 private:
  std::span<const float> o_;
};

struct Roll {
  bool isKnown = false;
  double x = 0.0;  ///< its current x [m]
  double y = 0.0;
  double vx = 0.0;  ///< [m/s]
  double vy = 0.0;
};

/// Fits a straight line to the sights of the ball by least squares.
Roll rollOf(const Look& look) {
  double n = 0, t1 = 0, t2 = 0, x0 = 0, x1 = 0, y0 = 0, y1 = 0;
  for (std::size_t i = 0; i < kSights; ++i) {
    const Place p = look.ball(i);
    if (p.age > kKnown) break;
    const double t = -p.age;
    n += 1, t1 += t, t2 += t * t, x0 += p.x, x1 += p.x * t, y0 += p.y, y1 += p.y * t;
  }
  Roll roll;
  if (n == 0) return roll;
  roll = {true, x0 / n, y0 / n, 0.0, 0.0};
  const double determinant = n * t2 - t1 * t1;
  if (n < 3 || determinant < 1e-9) return roll;
  roll.vx = (n * x1 - t1 * x0) / determinant;
  roll.vy = (n * y1 - t1 * y0) / determinant;
  roll.x = (t2 * x0 - t1 * x1) / determinant;
  roll.y = (t2 * y0 - t1 * y1) / determinant;
  return roll;
}

/// Moves along its line to a place, facing across the field.
void slide(const Look& look, double wanted, std::span<float> action) {
  const double away = std::clamp(wanted, -kReach, kReach) - look.at(kY);
  const double across = look.at(kSin) >= 0.0 ? 1.0 : -1.0;
  const double fast = std::min(std::sqrt(kAcceleration * std::abs(away)), 8.0 * std::abs(away));
  const double tilt =
      std::clamp(kLine - look.at(kX), -0.2, 0.2) * (away * across > 0.0 ? 1.0 : -1.0);
  const double error = wrapAngle(across * (std::numbers::pi / 2.0 - tilt) - look.heading());
  action[0] =
      static_cast<float>(std::clamp(std::copysign(fast, away) * across / kKeeperSpeed, -1.0, 1.0));
  action[1] = static_cast<float>(std::clamp(4.0 * error / kTurnSpeed, -1.0, 1.0));
}

double blockingPlace(const Place& ball) { return ball.y * kLine / std::max(ball.x, kLine); }

void keep(const Look& look, std::span<float> action) {
  const Place newest = look.ball(0);
  if (newest.age > kKnown) return slide(look, 0.0, action);
  const Roll roll = rollOf(look);
  constexpr double kComes = 0.7;  // slower motion towards the goal may be noise [m/s]
  if (roll.vx < -kComes && roll.x > kLine)
    return slide(look, roll.y + (kLine - roll.x) / roll.vx * roll.vy, action);
  slide(look, blockingPlace(newest), action);
}

/// Turns to a lost ball and drives to it. @returns whether the ball is lost
bool fetch(const Look& look, std::span<float> action) {
  constexpr double kNewly = 0.25;  // below this age it is too near for the camera to see it [s]
  constexpr double kAside = 0.35;  // [rad]
  constexpr double kAway = 0.6;    // [m]
  const Place ball = look.ball(0);
  const double dx = ball.x - look.at(kX), dy = ball.y - look.at(kY);
  const double bearing = wrapAngle(std::atan2(dy, dx) - look.heading());
  if (ball.age > kNewly || (std::abs(bearing) < kAside && std::hypot(dx, dy) < kAway)) return false;
  action[0] = std::abs(bearing) < kAside ? 0.6f : 0.0f;
  action[1] = static_cast<float>(std::clamp(2.0 * bearing, -1.5, 1.5) / kTurnSpeed);
  action[2] = -1.0f;
  return true;
}

/// Takes the ball between its horns towards the corner that is farther from the keeper, and kicks
/// near the goal, where a keeper has no time. It never speeds up so fast that the ball bounces off.
void strike(const Look& look, bool isLost, std::span<float> action) {
  constexpr double kCorner = 0.75;  // distance from the goal's middle [m]
  constexpr double kGentle = 0.6;   // turn rate at which the ball stays between the horns [rad/s]
  constexpr double kFaster = 0.08;  // greatest increase of speed per step [m/s]
  constexpr double kNear = 2.0;     // distance from the goal line at which it kicks [m]
  if (fetch(look, action)) return;
  const double x = look.at(kX), y = look.at(kY);
  const Place other = look.other();
  // If the keeper is in the middle, both corners are equally far: it takes the one that it faces.
  const double ahead = y - x * std::tan(look.heading());
  const bool isAside = other.age < kOld && std::abs(other.y) > 0.15;
  const double side = (isAside ? -other.y : ahead) < 0.0 ? -1.0 : 1.0;
  const double error = wrapAngle(std::atan2(side * kCorner - y, -x) - look.heading());
  const bool knows = !isLost || look.at(kSigmaPosition) < 0.4;
  const double speed = std::abs(error) > 0.8 ? 0.3 : 0.8;
  action[0] = static_cast<float>(std::min(speed, std::max(look.at(kForward), 0.0) + kFaster));
  action[1] = static_cast<float>(std::clamp(2.0 * error, -kGentle, kGentle) / kTurnSpeed);
  action[2] = knows && x < kNear && std::abs(error) < 0.15 ? 1.0f : -1.0f;
}

void check(std::span<const float> observation, std::span<float> action, std::size_t seen,
           std::size_t acts) {
  if (observation.size() != seen || action.size() < acts)
    throw std::invalid_argument("an observation of " + std::to_string(observation.size()) +
                                " numbers and an action of " + std::to_string(action.size()) +
                                ", expected " + std::to_string(seen) + " and " +
                                std::to_string(acts));
}

}  // namespace

void heuristic(const EnvironmentInfo& environment, std::size_t agent,
               std::span<const float> observation, std::span<float> action) {
  if (agent >= environment.agents.size())
    throw std::invalid_argument(environment.id + " has no agent " + std::to_string(agent));
  check(observation, action, environment.observation.size(), environment.actions[agent].size());
  const Look look(observation);
  if (environment.agents[agent] == "keeper") return keep(look, action);
  strike(look, observation.size() == kLocalizedSize, action);
}

void blocking(std::span<const float> observation, std::span<float> action) {
  check(observation, action, kPlainSize, 2);
  const Look look(observation);
  const Place ball = look.ball(0);
  slide(look, ball.age > kKnown ? 0.0 : blockingPlace(ball), action);
}

}  // namespace ortung::learning
