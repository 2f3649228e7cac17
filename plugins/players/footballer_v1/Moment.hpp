#pragma once

// FROZEN, a part of the team footballer-v1: docs/matches.md tells why. Never changed; improvements
// are made in the players of today.

#include "Chassis.hpp"
#include "Ground.hpp"
#include "Hands.hpp"
#include "View.hpp"

namespace ortung::football_v1 {

/// The input of a skill in one cycle. Everything is borrowed for one call.
struct Moment {
  const View& view;
  const Ground& ground;
  const Chassis& chassis;
  Hands& hands;
  RobotCommands& robot;
  double forward = 1.0;  ///< direction of the other goal along x, 1 or -1

  FloorPoint ownGoal() const { return ground.goal(-forward); }
  FloorPoint otherGoal() const { return ground.goal(forward); }
};

}  // namespace ortung::football_v1
