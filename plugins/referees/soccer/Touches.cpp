#include "Touches.hpp"

#include <algorithm>
#include <cmath>

namespace ortung::soccer {
namespace {

/// Change of the ball's velocity within a cycle that means a touch [m/s]. Rolling and sliding
/// change it by less: 0.2 m/s at 20 ms and full friction.
constexpr double kTurn = 0.3;

}  // namespace

bool Touches::hasTurned(const Scene::Ball& ball) const {
  return before_ && std::hypot(ball.vx - before_->vx, ball.vy - before_->vy) > kTurn;
}

void Touches::look(const Scene& scene) {
  if (!scene.ball) {
    before_.reset();
    return;
  }
  const Scene::Ball& ball = *scene.ball;
  double reach = margin_;
  if (hasTurned(ball)) {  // greatest distance that it has moved since it was touched
    const double speed =
        std::max(std::hypot(ball.vx, ball.vy), std::hypot(before_->vx, before_->vy));
    reach += speed * toSeconds(scene.now - at_);
  }
  const Scene::Robot* who = nullptr;
  for (const Scene::Robot& robot : scene.robots) {
    if (!robot.team || robot.toBall > reach) continue;
    if (who == nullptr || robot.toBall < who->toBall) who = &robot;
  }
  before_ = ball;
  at_ = scene.now;
  if (who == nullptr) return;
  lastTeam_ = who->team;
  lastRobot_ = who->name;
  lastPlace_ = {ball.x, ball.y};
  if (robots_ == 0) first_ = who->name;
  robots_ = first_ == who->name ? std::max(robots_, 1) : 2;
}

void Touches::reset() {
  lastTeam_.reset();
  lastRobot_.clear();
  lastPlace_ = {};
  first_.clear();
  robots_ = 0;
  before_.reset();
}

}  // namespace ortung::soccer
