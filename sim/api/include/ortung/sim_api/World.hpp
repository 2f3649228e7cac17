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
  double x = 0.0;           ///< origin in the field frame [m]
  double y = 0.0;           ///< [m]
  double z = 0.0;           ///< [m]
  double firstAngle = 0.0;  ///< of ray 0 in the field frame [rad]
  double angleStep = 0.0;   ///< [rad]
  double elevation = 0.0;   ///< of all rays above the plane [rad]
  double maxRange = 8.0;    ///< [m]
};

/// Circular cones from one point, their axes level and at evenly spaced angles.
struct ConeFan {
  double x = 0.0;           ///< apex in the field frame [m]
  double y = 0.0;           ///< [m]
  double z = 0.0;           ///< [m]
  double firstAngle = 0.0;  ///< of cone 0's axis in the field frame [rad]
  double angleStep = 0.0;   ///< between axes [rad]
  double halfAngle = 0.17;  ///< between axis and edge [rad], in (0, 1.5)
  double maxRange = 3.0;    ///< [m]
};

/// Which robot's own body rays ignore; 0: none.
using RobotNumber = std::uint32_t;

/// A point on the floor [m]; in the field frame unless somebody says otherwise.
struct FloorPoint {
  double x = 0.0;
  double y = 0.0;
};

/// A convex piece of a body: an upright prism or elliptic cylinder.
struct WorldPiece {
  enum class Shape { rectangle, ellipse, triangle };

  Shape shape = Shape::rectangle;
  Pose2 pose;          ///< of its middle, in the frame of its object; a triangle's heading is 0
  double halfX = 0.0;  ///< half its size along its own axes [m]; 0 of a triangle
  double halfY = 0.0;  ///< [m]
  std::array<FloorPoint, 3> corners{};  ///< of a triangle, in the frame of its object
  double zLow = 0.0;                    ///< [m]
  double zHigh = 0.0;                   ///< [m]
  std::string colour;                   ///< of its own, or empty: as the object's
};

/// A body that a sensor may recognise: a ball, a robot, a post, an obstacle, ...
struct WorldObject {
  std::string kind;        ///< "ball", "robot", "goal", "post", "wall", "obstacle", ...
  std::string name;        ///< as in the world file, or the robot's
  std::string colour;      ///< "blue", "#rrggbb" or empty
  Pose2 pose;              ///< of its middle, in the field frame
  Twist velocity;          ///< in the field frame
  double radius = 0.0;     ///< of the circle around its middle that holds it all [m]
  double halfX = 0.0;      ///< half its extent along its own axes [m]
  double halfY = 0.0;      ///< [m]
  double zLow = 0.0;       ///< [m]
  double zHigh = 0.0;      ///< [m]
  bool isRound = false;    ///< an ellipse; else what fits into a rectangle of the extent
  bool isMovable = false;  ///< false: it stands where it is
  RobotNumber robot = 0;   ///< which robot it is; 0: none
  std::string team;        ///< of a robot, whose upper part shows it to cameras; "": none
  bool isNet = false;      ///< a goal's net, which cameras look through and nothing else does
  /// What it is made of; at least one piece of all that a simulator's world has.
  std::vector<WorldPiece> pieces;
};

/// The outline of a piece where its object is now, in the field frame: corners in order against the
/// clock, of an ellipse @p corners points on it. @param corners at least 3
ORTUNG_API std::vector<FloorPoint> outlineOf(const WorldObject& object, const WorldPiece& piece,
                                             int corners = 48);

/// The room that a robot takes: an upright cylinder on the floor.
struct RobotSize {
  double radius = 0.0;  ///< [m]
  double height = 0.5;  ///< [m]
  auto operator<=>(const RobotSize&) const = default;
};

/// What a sensor plugin may ask of the world. Embree stays behind it.
/// Queries are thread-safe while nobody moves the world.
class ORTUNG_API World {
 public:
  virtual ~World();

  /// Range of each ray of the fan to the first surface [m], or fan.maxRange (as a float) where
  /// there is none; ranges.size() is the number of rays.
  virtual void castFan(const RayFan& fan, RobotNumber ignore, std::span<float> ranges) const = 0;

  /// Distance from the apex to the nearest surface within each cone of the fan [m], or fan.maxRange
  /// (as a float) where there is none; ranges.size() is the number of cones. By default of rays two
  /// degrees apart or less, in seven slices; a world that knows its bodies misses none of them.
  virtual void castCones(const ConeFan& fan, RobotNumber ignore, std::span<float> ranges) const;

  /// Whether nothing stands between two points at the given heights, but for what lies within
  /// @p slack metres of the second (so that a post does not hide itself).
  virtual bool isVisible(double x0, double y0, double z0, double x1, double y1, double z1,
                         RobotNumber ignore, double slack) const = 0;

  virtual std::span<const Landmark> landmarks() const = 0;

  /// All lines painted on the floor, in no order that means anything.
  virtual std::span<const FieldLine> lines() const { return {}; }

  /// All bodies but walls from maps: first what is fixed, then what moves, where it is now. While
  /// tables are learned there is nothing that moves.
  virtual std::span<const WorldObject> objects() const { return {}; }

  /// Straight walls of maps, as whole walls rather than cells. None of a world without maps.
  virtual std::span<const FieldWall> mapWalls() const { return {}; }

  /// Whether something of this size that stands at a place touches nothing solid that is as high
  /// as it, and lies within the field: it fits under a crossbar if it is no higher.
  virtual bool isFree(double x, double y, const RobotSize& size) const = 0;

  /// Draws what a camera sees of lines, bodies, walls and floor: bodies where rays meet them, but
  /// balls are round.
  /// @throws std::runtime_error where pictures can't be drawn, with what would have to be installed
  virtual void draw(const Drawing& drawing, const Sheet& sheet) const;
};

/// What a robot may know of a world beforehand: all of it that does not move.
ORTUNG_API FieldModel fieldModelOf(const World& world);

}  // namespace ortung
