#pragma once

// FROZEN, a part of the team footballer-v1: docs/matches.md tells why. Never changed; improvements
// are made in the players of today.

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "Plane.hpp"
#include "ortung/base/Parameters.hpp"
#include "ortung/tables/FieldModel.hpp"

namespace ortung {

/// A soccer field as its players know it: its middle is the origin, goals are at the ends of x.
struct Ground {
  double halfLength = 0.0;  ///< half the length between the goal lines [m]
  double halfWidth = 0.0;   ///< half the width between the touch lines [m]
  double halfMouth = 1.0;   ///< half the width of the goals between the posts [m]
  std::vector<Disc> posts;  ///< obstacles at its border: goals and corner posts

  FloorPoint goal(double end) const { return {end * halfLength, 0.0}; }
  /// Returns the nearest place at least @p margin [m] inside the lines; a negative margin is
  /// outside.
  FloorPoint within(const FloorPoint& at, double margin) const {
    const double x = std::max(halfLength - margin, 0.0);
    const double y = std::max(halfWidth - margin, 0.0);
    return {std::clamp(at.x, -x, x), std::clamp(at.y, -y, y)};
  }

  /// Makes the ground from goals and lines of the field; lengths in @p sizes ([m], 0: none) take
  /// precedence.
  /// @throws std::runtime_error for missing lengths
  static Ground of(const FieldModel& field, const Ground& sizes) {
    Ground ground = sizes;
    double length = 0.0;
    double width = 0.0;
    for (const Landmark& landmark : field.landmarks) {
      if (landmark.kind == "goal") length = std::max(length, std::abs(landmark.x));
      if (landmark.kind == "post") ground.posts.push_back({{landmark.x, landmark.y}, 0.1});
    }
    for (const FieldLine& line : field.lines)
      if (line.shape == FieldLine::Shape::kStraight)
        width = std::max({width, std::abs(line.y0), std::abs(line.y1)});
    if (ground.halfLength <= 0.0) ground.halfLength = length;
    if (ground.halfWidth <= 0.0) ground.halfWidth = width;
    if (ground.halfLength <= 0.0 || ground.halfWidth <= 0.0)
      throw std::runtime_error(
          "nothing is known of the field's goals and lines: it needs the options length_m and "
          "width_m, or tables (--tables)");
    if (ground.halfMouth <= 0.0) ground.halfMouth = mouthOf(field);
    for (const double end : {-1.0, 1.0})
      for (const double side : {-1.0, 1.0}) ground.addGoal(end, side);
    return ground;
  }

 private:
  /// Adds half a goal: its side with the post, and its inside, where robots must not go.
  void addGoal(double end, double side) {
    for (const double behind : {0.0, 0.25, 0.5})
      posts.push_back({{end * (halfLength + behind), side * (halfMouth + 0.08)}, 0.1});
    for (const double share : {0.2, 0.65})
      posts.push_back({{end * (halfLength + 0.35), side * share * halfMouth}, 0.25 * halfMouth});
  }
  static double mouthOf(const FieldModel& field) {
    double mouth = 1e9;
    for (const FieldWall& wall : field.walls)
      if (wall.ofGoal) mouth = std::min({mouth, std::abs(wall.y0), std::abs(wall.y1)});
    constexpr double kUsual = 1.0;
    return mouth < 1e8 && mouth > 0.2 ? mouth : kUsual;
  }
};

}  // namespace ortung
