#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "ortung/base/Pose2.hpp"

namespace ortung {

/// Something with an identity that a sensor can recognise, e.g. a corner post.
struct Landmark {
  std::uint32_t identity = 0;  ///< its number within its kind: post 3
  std::string kind;            ///< "post"
  double x = 0.0;              ///< position in the field frame [m]
  double y = 0.0;              ///< [m]
  double z = 0.0;              ///< height at which it is looked at [m]
};

/// A line painted on the floor: straight, or along an ellipse. A filled spot is an arc whose width
/// is twice its radius. The border of a painted triangle is three straight lines of width 0.
struct FieldLine {
  enum class Shape { kStraight, kArc };
  Shape shape = Shape::kStraight;
  double x0 = 0.0, y0 = 0.0;  ///< one end of a straight line's middle [m]
  double x1 = 0.0, y1 = 0.0;  ///< the other end [m]
  double x = 0.0, y = 0.0;    ///< middle of the ellipse along which an arc runs [m]
  double radiusX = 0.0;  ///< semi-axis of the arc's middle line along the ellipse's own x axis [m]
  double radiusY = 0.0;  ///< semi-axis along its y axis [m]
  double angle = 0.0;    ///< angle of the ellipse's own x axis in the field [rad]
  double from = 0.0;     ///< t of (radiusX cos t, radiusY sin t) where an arc begins [rad]
  double to = 0.0;       ///< t where it ends [rad]; from < to
  double width = 0.0;    ///< width of the painted line [m]
  std::string colour;    ///< "white", "#rrggbb" or empty
};

/// A straight surface of something solid that does not move. Seen along the direction from the
/// first end to the second, the solid is on the right and the free side on the left.
struct FieldWall {
  double x0 = 0.0;  ///< first end in the field frame [m]
  double y0 = 0.0;
  double x1 = 0.0;
  double y1 = 0.0;
  double zLow = 0.0;    ///< height of its lower edge [m]
  double zHigh = 0.0;   ///< height of its upper edge [m]
  bool ofGoal = false;  ///< whether it belongs to a goal, not to a wall
};

/// Returns the length of the surface along the floor [m].
inline double lengthOf(const FieldWall& wall) {
  return std::hypot(wall.x1 - wall.x0, wall.y1 - wall.y0);
}

/// A goal: a body whose mouth looks along its own x axis or against it.
struct FieldGoal {
  std::string name;    ///< name in the world file
  std::string colour;  ///< "blue", "#rrggbb" or empty
  Pose2 pose;          ///< pose of the goal's middle in the field frame
  double halfX = 0.0;  ///< half its extent along its own x axis [m]
  double halfY = 0.0;  ///< half its extent along its own y axis [m]
  double zHigh = 0.0;  ///< height above the floor [m]
};

/// What a robot knows of the field beforehand, besides what its sensors learn. Features that are
/// made of other features (Extractor) use it. The learner takes it from the world and keeps it with
/// the tables.
struct FieldModel {
  std::vector<FieldLine> lines;
  std::vector<FieldWall> walls;  ///< the longest first
  std::vector<FieldGoal> goals;
  std::vector<Landmark> landmarks;

  bool isEmpty() const {
    return lines.empty() && walls.empty() && goals.empty() && landmarks.empty();
  }
};

}  // namespace ortung
