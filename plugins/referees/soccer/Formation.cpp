#include "Formation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ortung::soccer {
namespace {

double headingOf(double direction) { return direction > 0.0 ? 0.0 : std::numbers::pi; }

/// Returns the pose at a place given in shares of a team's half, facing the other goal.
Pose2 poseAt(const FloorPoint& share, double direction, const Pitch& pitch) {
  return {direction * share.x * pitch.halfLength, direction * share.y * pitch.halfWidth,
          headingOf(direction)};
}

/// Returns the pose behind the ball, facing it and the other goal.
Pose2 behind(const FloorPoint& ball, double ballRadius, const Scene::Robot& robot, double gap,
             double direction) {
  return {ball.x - direction * (robot.size.radius + ballRadius + gap), ball.y,
          headingOf(direction)};
}

class Formations {
 public:
  Formations(const Scene& scene, const Restart& restart, const Pitch& pitch, const Rules& rules,
             const Game& game)
      : scene_(scene), restart_(restart), pitch_(pitch), rules_(rules), game_(game) {}

  std::vector<Wish> make() {
    std::vector<Wish> wishes;
    for (std::size_t i = 0; i < scene_.robots.size(); ++i) {
      const Scene::Robot& robot = scene_.robots[i];
      if (!robot.team) continue;
      Wish wish{i, robot.pose, 0.0, game_.directionOf(game_.teams[*robot.team].name)};
      wish.keepAway = keepAway(robot);
      if (restart_.kind == Game::Restart::kKickOff) {
        forKickOff(robot, wish);
      } else if (restart_.kind == Game::Restart::kPenalty) {
        forPenalty(robot, wish);
      }
      wishes.push_back(wish);
    }
    return wishes;
  }

 private:
  double ballRadius() const { return scene_.ball ? scene_.ball->radius : rules_.ball.radius; }

  bool isTaker(const Scene::Robot& robot) const {
    if (robot.team != restart_.team || !restart_.team) return false;
    if (restart_.kind != Game::Restart::kKickOff)
      return nearest(scene_, *robot.team, restart_.place) == &robot;
    const auto last = std::find_if(scene_.robots.rbegin(), scene_.robots.rend(),
                                   [&](const auto& other) { return other.team == robot.team; });
    return &*last == &robot;
  }

  /// Returns whether a robot is the one of its team nearest to its goal, in its own penalty area.
  bool isKeeper(const Scene::Robot& robot) const {
    const double side = -game_.directionOf(game_.teams[*robot.team].name);
    return nearest(scene_, *robot.team, {side * pitch_.halfLength, 0.0}) == &robot &&
           pitch_.isIn(pitch_.penaltyArea, side, robot.pose.x, robot.pose.y);
  }

  double keepAway(const Scene::Robot& robot) const {
    if (restart_.kind == Game::Restart::kDroppedBall) return rules_.restart.droppedBall;
    if (robot.team == restart_.team) return isTaker(robot) ? 0.0 : rules_.restart.ownKeepAway;
    const bool stays =
        rules_.restart.keeperStays && restart_.kind != Game::Restart::kKickOff && isKeeper(robot);
    return stays ? 0.0 : rules_.restart.keepAway;
  }

  void forKickOff(const Scene::Robot& robot, Wish& wish) const {
    wish.inOwnHalf = true;
    const bool isOwn = robot.team == restart_.team;
    if (!isOwn)  // it is also outside of the circle
      wish.keepAway = std::max(wish.keepAway, pitch_.circle - ballRadius());
    if (isTaker(robot)) {
      wish.pose = behind(restart_.place, ballRadius(), robot, rules_.kickOff.taker, wish.direction);
      return;
    }
    const auto& places = isOwn ? rules_.kickOff.own : rules_.kickOff.other;
    const std::size_t number = numberInTeam(robot);
    if (number < places.size()) wish.pose = poseAt(places[number], wish.direction, pitch_);
  }

  void forPenalty(const Scene::Robot& robot, Wish& wish) const {
    if (isTaker(robot)) {
      wish.pose = behind(restart_.place, ballRadius(), robot, rules_.kickOff.taker, wish.direction);
      return;
    }
    const FloorPoint goal{-wish.direction * pitch_.halfLength, 0.0};
    const bool isKeeper =
        robot.team != restart_.team && nearest(scene_, *robot.team, goal) == &robot;
    if (isKeeper) {  // it is on its goal line
      wish.keepAway = 0.0;
      wish.pose = {goal.x + wish.direction * robot.size.radius, 0.0, headingOf(wish.direction)};
      return;
    }
    wish.behindPenalty = true;
  }

  std::size_t numberInTeam(const Scene::Robot& robot) const {
    std::size_t number = 0;
    for (const Scene::Robot& other : scene_.robots) {
      if (&other == &robot) break;
      number += other.team == robot.team ? 1 : 0;
    }
    return number;
  }

  const Scene& scene_;
  const Restart& restart_;
  const Pitch& pitch_;
  const Rules& rules_;
  const Game& game_;
};

}  // namespace

std::vector<Wish> formation(const Scene& scene, const Restart& restart, const Pitch& pitch,
                            const Rules& rules, const Game& game) {
  return Formations(scene, restart, pitch, rules, game).make();
}

}  // namespace ortung::soccer
