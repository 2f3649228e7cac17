#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "ortung/base/Pose2.hpp"
#include "ortung/sim/Primitive.hpp"
#include "ortung/sim_api/World.hpp"

namespace ortung {

/// Rays against moving bodies: upright prisms and elliptic cylinders, intersected in closed form in
/// double precision. Moving one changes a few numbers and nothing has to be rebuilt: each body is
/// tested against the few beams that point at it, which costs less than a tree over moving bodies.
/// Queries are thread-safe while nothing is changed.
class BodyRays {
 public:
  /// Adds a body. Bodies have places 0, 1, ... in the order in which they were added.
  /// @param number the number by which castFan() ignores it
  void add(std::span<const Primitive> pieces, RobotNumber number, const Pose2& pose);
  void move(std::size_t place, const Pose2& pose);
  void reshape(std::size_t place, std::span<const Primitive> pieces);
  /// Removes a body; the places behind it move up.
  void remove(std::size_t place);

  /// Shortens the ranges of the fan that end at a body.
  /// @pre all numbers are finite, maxRange is not negative
  void castFan(const RayFan& fan, RobotNumber ignore, std::span<float> ranges) const;

  /// Shortens the ranges of the cones in which a body is nearer, whatever its size: in closed form,
  /// for round bodies within half a millimetre. @pre as for castFan()
  void castCones(const ConeFan& fan, RobotNumber ignore, std::span<float> ranges) const;

  /// Returns whether the ray meets a body before @p stop [m].
  bool isBlocked(const std::array<double, 3>& from, const std::array<double, 3>& direction,
                 double stop, RobotNumber ignore) const;

 private:
  /// The points (x, y) relative to the middle with xx x + xy y <= offset for every side; for an
  /// ellipse those with (xx x + xy y)^2 + (yx x + yy y)^2 <= 1.
  struct Piece {
    bool isRound = false;
    std::size_t sides = 0;
    /// Rows (xx, xy) of the sides, or (xx, xy) and (yx, yy) of an ellipse.
    std::array<std::array<double, 2>, 4> normals{};
    std::array<double, 4> offsets{};  ///< offsets of the sides: n . p <= offset
    std::array<Point2, 4> corners{};  ///< corners relative to the middle; unused for an ellipse
    Point2 middle;                    ///< middle in the field frame [m]
    double reach = 0.0;               ///< greatest distance of its points from its middle [m]
    double zLow = 0.0, zHigh = 0.0;
  };
  struct Body {
    RobotNumber number;
    Pose2 pose;
    std::vector<Piece> shape;   ///< its pieces in its own frame
    std::vector<Piece> pieces;  ///< its pieces in the field frame
    double reach = 0.0;         ///< greatest distance of its points from its own origin [m]
  };
  struct Ray {
    double x, y, z;     ///< origin [m]
    double dx, dy, dz;  ///< unit direction
  };

  static Piece pieceOf(const Primitive& primitive);
  static std::optional<double> hit(const Piece& piece, const Ray& ray);
  /// The angles that all beams of a fan have in common.
  struct FanTurn {
    double level, rise;  ///< cosine and sine of the elevation
    double cos, sin;     ///< cosine and sine of the step from beam to beam
  };
  static void castAt(const Piece& piece, const RayFan& fan, const FanTurn& turn,
                     std::span<float> ranges);
  static std::size_t outlineOf(const Piece& piece, const Point2& middle, std::span<Point2> outline);
  static void castConesAt(const Piece& piece, const ConeFan& fan, std::span<float> ranges);

  std::vector<Body> bodies_;
};

}  // namespace ortung
