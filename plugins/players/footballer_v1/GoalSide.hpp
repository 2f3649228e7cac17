#pragma once

// FROZEN, a part of the team footballer-v1: docs/matches.md tells why. Never changed; improvements
// are made in the players of today.

#include <optional>
#include <stdexcept>
#include <string>

#include "ortung/sim_api/Player.hpp"

namespace ortung {

/// The goal at one end of the field, as a player knows it from the field's landmarks of kind
/// "goal".
struct GoalSide {
  FloorPoint middle;     ///< middle of its mouth in the field frame [m]
  double inwards = 1.0;  ///< direction from it into the field along x, 1 or -1

  /// Finds the goal. @param end 1: the goal at the largest x, -1: at the smallest
  /// @throws std::runtime_error if the field has none there
  static GoalSide at(const FieldModel& field, double end) {
    std::optional<GoalSide> found;
    for (const Landmark& landmark : field.landmarks)
      if (landmark.kind == "goal" && landmark.x * end > 0.0 &&
          (!found || landmark.x * end > found->middle.x * end))
        found = GoalSide{{landmark.x, landmark.y}, -end};
    if (!found)
      throw std::runtime_error(std::string("the field has no landmark of kind 'goal' at its ") +
                               (end > 0.0 ? "positive" : "negative") + " end of x");
    return *found;
  }
  /// Returns the point at a distance before the goal line, and to the left of its middle [m].
  FloorPoint before(double depth, double aside) const {
    return {middle.x + inwards * depth, middle.y + aside};
  }
  /// Returns the distance before the goal line [m].
  double depthOf(double x) const { return (x - middle.x) * inwards; }
};

}  // namespace ortung
