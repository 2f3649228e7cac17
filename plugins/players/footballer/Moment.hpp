#pragma once

#include "Chassis.hpp"
#include "Ground.hpp"
#include "Hands.hpp"
#include "View.hpp"

namespace ortung::football {

/// What a skill acts on. All of it is borrowed for one call.
struct Moment {
  const View& view;
  const Ground& ground;
  const Chassis& chassis;
  Hands& hands;
  RobotCommands& robot;
  double forward = 1.0;  ///< 1 or -1: towards the other goal along x

  FloorPoint ownGoal() const { return ground.goal(-forward); }
  FloorPoint otherGoal() const { return ground.goal(forward); }
};

}  // namespace ortung::football
