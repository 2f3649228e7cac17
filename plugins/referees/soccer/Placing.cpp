#include "Placing.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace ortung::soccer {
namespace {

constexpr double kStep = 0.1;         ///< step between rings of the search, and along them [m]
constexpr double kThere = 0.05;       ///< distance within which a wish is fulfilled [m]
constexpr double kThereTurned = 0.1;  ///< turn within which a wish is fulfilled [rad]
constexpr double kHair = 1e-6;        ///< tolerance of rounding errors [m]
constexpr int kMostRefusals = 200;    ///< greatest number of refused attempts for one robot
constexpr double kBallSearch = 2.0;   ///< greatest distance of the ball from its wanted place [m]

std::string told(double value) {
  const double rounded = std::round(value * 100.0) / 100.0;
  std::string text = std::to_string(rounded);
  return text.substr(0, text.find('.') + 3);
}

}  // namespace

Placing::Placing(Stage& stage, const Scene& scene, const Pitch& pitch, double gap)
    : stage_(stage), scene_(scene), pitch_(pitch), gap_(gap) {
  for (const Scene::Robot& robot : scene.robots) poses_.push_back(robot.pose);
}

/// Tries poses on rings around a pose, the nearest first, beginning on the side opposite to the
/// ball.
template <class Try>
bool Placing::search(const Pose2& around, const Try& attempt) const {
  const double away = std::atan2(around.y - ball_.y, around.x - ball_.x);
  const double farthest = 2.0 * std::hypot(pitch_.halfLength, pitch_.halfWidth);
  for (double radius = 0.0; radius <= farthest; radius += kStep) {
    const double steps = std::ceil(std::numbers::pi * radius / kStep);
    for (double i = 0.0; i <= steps; i += 1.0) {
      for (const double side : {1.0, -1.0}) {
        const double angle = away + side * i * std::numbers::pi / std::max(steps, 1.0);
        if (attempt(around.x + radius * std::cos(angle), around.y + radius * std::sin(angle)))
          return true;
        if (i == 0.0) break;
      }
      if (radius == 0.0) break;
    }
  }
  return false;
}

bool Placing::isPermitted(const Wish& wish, double x, double y) const {
  const Scene::Robot& robot = scene_.robots[wish.robot];
  const double radius = robot.size.radius;
  if (hasBall_) {
    const double toBall = std::hypot(x - ball_.x, y - ball_.y) - radius - scene_.ball->radius;
    if (toBall < std::max(wish.keepAway, gap_) - kHair) return false;
  }
  if (wish.inOwnHalf && -wish.direction * x < radius - kHair) return false;
  if (wish.behindPenalty) {
    const double end = ball_.x < 0.0 ? -1.0 : 1.0;
    if (pitch_.isIn(pitch_.penaltyArea, end, x, y) || x * end > ball_.x * end) return false;
  }
  return true;
}

bool Placing::isEmpty(std::size_t robot, double x, double y) const {
  const RobotSize& size = scene_.robots[robot].size;
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    if (i == robot) continue;
    const double apart = std::hypot(poses_[i].x - x, poses_[i].y - y);
    if (apart < size.radius + scene_.robots[i].size.radius + gap_) return false;
  }
  return stage_.world().isFree(x, y, size);
}

/// Returns whether no other robot has its wanted place there.
bool Placing::isOfNobody(const Wish& wish, double x, double y) const {
  const double radius = scene_.robots[wish.robot].size.radius;
  return std::none_of(wishes_.begin(), wishes_.end(), [&](const Wish& other) {
    const double reach = radius + scene_.robots[other.robot].size.radius + gap_;
    return other.robot != wish.robot && std::hypot(other.pose.x - x, other.pose.y - y) < reach;
  });
}

bool Placing::isThere(const Wish& wish) const {
  const Pose2& pose = poses_[wish.robot];
  return distance(pose, wish.pose) < kThere &&
         std::abs(wrapAngle(pose.theta - wish.pose.theta)) < kThereTurned &&
         isPermitted(wish, pose.x, pose.y);
}

bool Placing::put(std::size_t robot, const Pose2& pose) {
  try {
    stage_.placeRobot(scene_.robots[robot].name, pose);
  } catch (const std::invalid_argument&) {
    return false;  // there is no room according to the stage
  }
  poses_[robot] = pose;
  return true;
}

bool Placing::putExactly(const Wish& wish) {
  return isPermitted(wish, wish.pose.x, wish.pose.y) &&
         isEmpty(wish.robot, wish.pose.x, wish.pose.y) && put(wish.robot, wish.pose);
}

/// Moves a robot out of the way of the others.
bool Placing::park(const Wish& wish) {
  int refusals = 0;
  return search(poses_[wish.robot], [&](double x, double y) {
    if (refusals > kMostRefusals || !isEmpty(wish.robot, x, y) || !isOfNobody(wish, x, y))
      return false;
    if (put(wish.robot, {x, y, wish.pose.theta})) return true;
    ++refusals;
    return false;
  });
}

bool Placing::putNear(const Wish& wish) {
  int refusals = 0;
  const double radius = scene_.robots[wish.robot].size.radius;
  return search(wish.pose, [&](double x, double y) {
    if (refusals > kMostRefusals) return false;
    const bool isOnPitch = std::abs(x) <= std::max(pitch_.halfLength - radius, 0.0) + kHair &&
                           std::abs(y) <= std::max(pitch_.halfWidth - radius, 0.0) + kHair;
    if (!isOnPitch || !isPermitted(wish, x, y) || !isEmpty(wish.robot, x, y)) return false;
    if (put(wish.robot, {x, y, wish.pose.theta})) return true;
    ++refusals;
    return false;
  });
}

void Placing::settle(std::vector<Wish> pending, std::vector<std::string>& problems) {
  const auto placeAll = [&](auto&& way) {
    bool progress = true;
    while (progress && !pending.empty()) {
      const auto before = pending.size();
      std::erase_if(pending, way);
      progress = pending.size() < before;
    }
  };
  const auto exactly = [this](const Wish& wish) { return putExactly(wish); };
  placeAll(exactly);
  // Robots that wait for each other are moved aside one by one.
  const std::vector<Wish> blocked = pending;
  for (const Wish& wish : blocked) {
    const bool waits = isPermitted(wish, wish.pose.x, wish.pose.y) &&
                       std::any_of(pending.begin(), pending.end(),
                                   [&](const Wish& w) { return w.robot == wish.robot; });
    if (waits && park(wish)) placeAll(exactly);
  }
  placeAll([this](const Wish& wish) { return putNear(wish); });
  for (const Wish& wish : pending)
    problems.push_back("there is no room for " + scene_.robots[wish.robot].name);
}

std::vector<std::string> Placing::place(const std::vector<Wish>& wishes, const Restart& restart) {
  std::vector<std::string> problems;
  hasBall_ = scene_.ball.has_value();
  ball_ = restart.place;
  wishes_ = wishes;
  std::vector<Wish> pending;
  for (const Wish& wish : wishes)
    if (!isThere(wish)) pending.push_back(wish);
  settle(std::move(pending), problems);
  for (std::string& problem : placeBall(restart.place)) problems.push_back(std::move(problem));
  return problems;
}

bool Placing::isFreeOfBall(const FloorPoint& at) const {
  const double radius = scene_.ball->radius;
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    const double apart = std::hypot(poses_[i].x - at.x, poses_[i].y - at.y);
    if (apart < radius + scene_.robots[i].size.radius) return false;
  }
  return true;
}

std::vector<std::string> Placing::placeBall(const FloorPoint& at) {
  if (!scene_.ball) return {};
  ball_ = at;
  int refusals = 0;
  const bool isPlaced = search({at.x, at.y, 0.0}, [&](double x, double y) {
    if (refusals > kMostRefusals || std::hypot(x - at.x, y - at.y) > kBallSearch) return false;
    const bool isOnPitch = std::abs(x) <= pitch_.halfLength && std::abs(y) <= pitch_.halfWidth;
    if (!isOnPitch || !isFreeOfBall({x, y})) return false;
    try {
      stage_.placeThing(scene_.ball->name, {x, y, 0.0});
    } catch (const std::invalid_argument&) {
      ++refusals;
      return false;
    }
    return true;
  });
  if (isPlaced) return {};
  return {"there is no room for the ball at (" + told(at.x) + ", " + told(at.y) + ")"};
}

}  // namespace ortung::soccer
