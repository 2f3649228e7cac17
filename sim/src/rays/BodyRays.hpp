#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "ortung/base/Pose2.hpp"
#include "ortung/sim/Primitive.hpp"
#include "ortung/sim_api/World.hpp"

namespace ortung {

/// Rays against what moves: upright prisms and elliptic cylinders, met in closed form in double
/// precision. Moving one changes a few numbers and nothing has to be built: a fan meets each body
/// in the few beams that point at it, so that costs less than any tree over things that move.
/// Queries are thread-safe while nobody changes anything.
class BodyRays {
 public:
  /// Bodies have places 0, 1, ... in the order in which they were added.
  /// @param number by which castFan() ignores it
  void add(std::span<const Primitive> pieces, RobotNumber number, const Pose2& pose);
  void move(std::size_t place, const Pose2& pose);
  void reshape(std::size_t place, std::span<const Primitive> pieces);
  /// Those behind it move up.
  void remove(std::size_t place);

  /// Shortens those ranges of the fan that end at a body.
  /// @pre all numbers are finite, maxRange is not negative
  void castFan(const RayFan& fan, RobotNumber ignore, std::span<float> ranges) const;

  /// Shortens those ranges of the cones in which a body is nearer, whatever its size: in closed
  /// form, round ones within half a millimetre. @pre as for castFan()
  void castCones(const ConeFan& fan, RobotNumber ignore, std::span<float> ranges) const;

  /// Whether a body is met before @p stop metres.
  bool isBlocked(const std::array<double, 3>& from, const std::array<double, 3>& direction,
                 double stop, RobotNumber ignore) const;

 private:
  /// All (x, y) with xx x + xy y <= 1 for every side, relative to the middle; or, of an ellipse,
  /// with (xx x + xy y)^2 + (yx x + yy y)^2 <= 1.
  struct Piece {
    bool isRound = false;
    std::size_t sides = 0;
    std::array<std::array<double, 2>, 4> normals{};  ///< rows (xx, xy), of an ellipse also (yx, yy)
    std::array<double, 4> offsets{};                 ///< n . p <= offset
    std::array<Point2, 4> corners{};                 ///< from the middle; not of an ellipse
    Point2 middle;                                   ///< in the field [m]
    double reach = 0.0;                              ///< of all of it from its middle [m]
    double zLow = 0.0, zHigh = 0.0;
  };
  struct Body {
    RobotNumber number;
    Pose2 pose;
    std::vector<Piece> shape;   ///< in its own frame
    std::vector<Piece> pieces;  ///< in the field
    double reach = 0.0;         ///< of all of it from its own origin [m]
  };
  struct Ray {
    double x, y, z;     ///< [m]
    double dx, dy, dz;  ///< of length 1
  };

  static Piece pieceOf(const Primitive& primitive);
  static std::optional<double> hit(const Piece& piece, const Ray& ray);
  /// What all beams of a fan have in common.
  struct FanTurn {
    double level, rise;  ///< cosine and sine of the elevation
    double cos, sin;     ///< of the step from beam to beam
  };
  static void castAt(const Piece& piece, const RayFan& fan, const FanTurn& turn,
                     std::span<float> ranges);
  static std::size_t outlineOf(const Piece& piece, const Point2& middle, std::span<Point2> outline);
  static void castConesAt(const Piece& piece, const ConeFan& fan, std::span<float> ranges);

  std::vector<Body> bodies_;
};

}  // namespace ortung
