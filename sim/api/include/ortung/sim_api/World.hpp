#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/sim_api/Drawing.hpp"
#include "ortung/sim_api/Twist.hpp"
#include "ortung/tables/FieldModel.hpp"

namespace ortung {

/// Rays from one point at evenly spaced angles in one plane parallel to the floor.
struct RayFan {
  double x = 0.0;           ///< x of the origin in the field frame [m]
  double y = 0.0;           ///< y of the origin [m]
  double z = 0.0;           ///< height of the origin above the floor [m]
  double firstAngle = 0.0;  ///< direction of ray 0 in the field frame [rad]
  double angleStep = 0.0;   ///< angle from one ray to the next [rad]
  double elevation = 0.0;   ///< angle of all rays above the horizontal [rad]
  double maxRange = 8.0;    ///< range where rays end [m]
};

/// Circular cones from one point, with horizontal axes at evenly spaced angles.
struct ConeFan {
  double x = 0.0;           ///< x of the apex in the field frame [m]
  double y = 0.0;           ///< y of the apex [m]
  double z = 0.0;           ///< height of the apex above the floor [m]
  double firstAngle = 0.0;  ///< direction of cone 0's axis in the field frame [rad]
  double angleStep = 0.0;   ///< angle from one axis to the next [rad]
  double halfAngle = 0.17;  ///< angle between axis and edge [rad], in (0, 1.5)
  double maxRange = 3.0;    ///< range where cones end [m]
};

/// A moving body's number, by which rays ignore it; 0: no body.
using RobotNumber = std::uint32_t;

/// A point on the floor [m], in the field frame unless its name says otherwise.
struct FloorPoint {
  double x = 0.0;
  double y = 0.0;
};

/// A convex piece of a body: an upright prism or elliptic cylinder.
struct WorldPiece {
  enum class Shape { kRectangle, kEllipse, kTriangle };

  Shape shape = Shape::kRectangle;
  Pose2 pose;          ///< pose of its middle in the frame of its object; a triangle's heading is 0
  double halfX = 0.0;  ///< half its size along its own x axis [m]; 0 for a triangle
  double halfY = 0.0;  ///< half its size along its own y axis [m]; 0 for a triangle
  std::array<FloorPoint, 3> corners{};  ///< a triangle's corners in the frame of its object
  double zLow = 0.0;                    ///< height of its bottom [m]
  double zHigh = 0.0;                   ///< height of its top [m]
  std::string colour;                   ///< its own colour; empty: the object's
};

/// A body that a sensor may recognise: a ball, a robot, a post, an obstacle, ...
struct WorldObject {
  std::string kind;     ///< "ball", "robot", "goal", "post", "wall", "obstacle", ...
  std::string name;     ///< its name in the world file, or the robot's name
  std::string colour;   ///< "blue", "#rrggbb" or empty
  Pose2 pose;           ///< pose of its middle in the field frame
  Twist velocity;       ///< velocity in the field frame
  double radius = 0.0;  ///< radius of the circle around its middle that encloses it [m]
  double halfX = 0.0;   ///< half its extent along its own x axis [m]
  double halfY = 0.0;   ///< half its extent along its own y axis [m]
  double zLow = 0.0;    ///< height of its bottom [m]
  double zHigh = 0.0;   ///< height of its top [m]
  /// Whether its plan is an ellipse; otherwise it fits into a rectangle of the extent.
  bool isRound = false;
  bool isMovable = false;  ///< whether it can be moved
  RobotNumber robot = 0;   ///< the robot's number; 0: it is not a robot
  std::string team;        ///< a robot's team, which its upper part shows to cameras; "": none
  bool isNet = false;  ///< whether it is a goal's net: cameras see through it, nothing else does
  /// The convex pieces that it is made of; objects of a simulated world have at least one.
  std::vector<WorldPiece> pieces;
};

/// Returns the outline of a piece at its object's current pose, in the field frame: its corners in
/// counter-clockwise order; for an ellipse @p corners points on it. @param corners at least 3
ORTUNG_API std::vector<FloorPoint> outlineOf(const WorldObject& object, const WorldPiece& piece,
                                             int corners = 48);

/// The space that a robot takes up: an upright cylinder on the floor.
struct RobotSize {
  double radius = 0.0;  ///< radius of the cylinder [m]
  double height = 0.5;  ///< height of the cylinder [m]
  auto operator<=>(const RobotSize&) const = default;
};

/// The world as sensor plugins see it; Embree is hidden behind it. Queries are thread-safe while
/// the world is not changed.
class ORTUNG_API World {
 public:
  virtual ~World();

  /// Writes the range of each ray of the fan to the first surface [m], or fan.maxRange (as a float)
  /// where there is none; ranges.size() is the number of rays.
  virtual void castFan(const RayFan& fan, RobotNumber ignore, std::span<float> ranges) const = 0;

  /// Writes the distance from the apex to the nearest surface within each cone of the fan [m], or
  /// fan.maxRange (as a float) where there is none; ranges.size() is the number of cones. By
  /// default it casts rays at most two degrees apart in seven slices; a world that knows its bodies
  /// misses none of them.
  virtual void castCones(const ConeFan& fan, RobotNumber ignore, std::span<float> ranges) const;

  /// Returns whether the straight line between two points [m] is free, ignoring everything within
  /// @p slack [m] of the second one (so that a post does not hide itself).
  virtual bool isVisible(double x0, double y0, double z0, double x1, double y1, double z1,
                         RobotNumber ignore, double slack) const = 0;

  /// Returns all landmarks.
  virtual std::span<const Landmark> landmarks() const = 0;

  /// Returns all lines painted on the floor, in no particular order.
  virtual std::span<const FieldLine> lines() const { return {}; }

  /// Returns all bodies except the walls of maps: first the fixed ones, then the moving ones at
  /// their current poses. While tables are learned nothing moves.
  virtual std::span<const WorldObject> objects() const { return {}; }

  /// Returns the straight walls of maps as segments, not as cells; none for a world without maps.
  virtual std::span<const FieldWall> mapWalls() const { return {}; }

  /// Returns whether a robot of this size at (x, y) [m] touches nothing solid and lies within the
  /// field. It touches only bodies at its own heights: a low robot fits under a crossbar.
  virtual bool isFree(double x, double y, const RobotSize& size) const = 0;

  /// Draws what a camera sees of lines, bodies, walls and floor: bodies have the shapes that rays
  /// meet, except that balls are spheres.
  /// @throws std::runtime_error naming what must be installed, where pictures can't be drawn
  virtual void draw(const Drawing& drawing, const Sheet& sheet) const;

  /// Writes what the rays of a camera meet: what draw() shows, except that nets are seen through.
  /// @throws std::invalid_argument unless there are as many things and ranges as rays
  virtual void trace(const Sight& sight, const Traced& traced) const;
};

/// Returns what a robot may know of a world in advance: everything that does not move.
ORTUNG_API FieldModel fieldModelOf(const World& world);

}  // namespace ortung
