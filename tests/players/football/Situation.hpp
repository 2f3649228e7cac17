#pragma once

#include <optional>

#include "Moment.hpp"

namespace ortung::football {

/// A field of 12 x 8 m with goals of 2 m.
inline Ground field() {
  Ground ground;
  ground.halfLength = 6.0;
  ground.halfWidth = 4.0;
  ground.halfMouth = 1.0;
  return ground;
}

/// Does nothing.
struct Mute : RobotCommands {
  void setTranslationalVelocity(double) override {}
  void setRotationalVelocity(double) override {}
  void setMotion(std::span<const double>) override {}
  void setManipulator(std::string_view, std::string_view) override {}
};

/// Somebody at the origin, who plays towards positive x with the ball before him.
struct Situation {
  View view;
  Ground ground = field();
  Chassis chassis{DriveLimits{1.5, 4.0, 2.0, 15.0}, std::nullopt};
  Hands hands{RobotAbilities{}};
  Mute robot;

  Situation() { view.ball = RollingBall{{0.28, 0.0}, 0.0, 0.0, 0.3}; }
  Moment moment() { return {view, ground, chassis, hands, robot, 1.0}; }
};

}  // namespace ortung::football
