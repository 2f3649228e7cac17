#include "ortung/vision/LinesInSight.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace ortung {
namespace {

constexpr double kStep = 0.1;          ///< distance between places that are looked for [m]
constexpr double kLeastLength = 0.6;   ///< shorter lines, such as marks, are easily missed [m]
constexpr double kLeastWidth = 2.0;    ///< thinner lines are not expected to be found [px]
constexpr double kLeastMark = 2.5;     ///< least radius of a spot's image [px]
constexpr double kAlong = 14.0;        ///< how far along the line its next point may be [px]
constexpr double kAcross = 4.0;        ///< how far off the line a point may be [px]
constexpr double kAcrossShare = 0.35;  ///< share of the line's width by which it may be off, too
constexpr double kBorder = 6.0;        ///< width of the image's border, where nothing is found [px]

/// A place on a line, and a point beside it in each direction.
struct Piece {
  LinePlace middle;
  LinePlace ahead;  ///< a step along the line
  LinePlace edge;   ///< a place on the line's edge
};

/// Calls @p what for pieces along a line, kStep apart.
template <typename What>
void eachPiece(const FieldLine& line, const What& what) {
  if (line.shape == FieldLine::Shape::kStraight) {
    const double length = std::hypot(line.x1 - line.x0, line.y1 - line.y0);
    if (length < kLeastLength) return;
    const double dx = (line.x1 - line.x0) / length;
    const double dy = (line.y1 - line.y0) / length;
    for (double d = 0.5 * kStep; d < length; d += kStep) {
      const LinePlace at{line.x0 + d * dx, line.y0 + d * dy};
      what(Piece{at,
                 {at.x + kStep * dx, at.y + kStep * dy},
                 {at.x - 0.5 * line.width * dy, at.y + 0.5 * line.width * dx}});
    }
    return;
  }
  const double most = std::max(line.radiusX, line.radiusY);
  if (!(most > 0.0) || (line.to - line.from) * most < kLeastLength) return;
  const double c = std::cos(line.angle);
  const double s = std::sin(line.angle);
  const auto place = [&](double t, double wider) {
    const double x = (line.radiusX + wider) * std::cos(t);
    const double y = (line.radiusY + wider) * std::sin(t);
    return LinePlace{line.x + c * x - s * y, line.y + s * x + c * y};
  };
  const double step = kStep / most;
  for (double t = line.from + 0.5 * step; t < line.to; t += step)
    what(Piece{place(t, 0.0), place(t + step, 0.0), place(t, 0.5 * line.width)});
}

class Sight {
 public:
  Sight(const CameraView& view, const Pose2& sensorInField, double range)
      : view_(view), fieldInSensor_(inverse(sensorInField)), range_(range) {}

  std::optional<Pixel> pixelOf(const LinePlace& inField) const {
    const Pose2 place = fieldInSensor_ * Pose2{inField.x, inField.y, 0.0};
    if (std::hypot(place.x, place.y) > range_) return std::nullopt;
    const auto pixel = view_.pixelOf({place.x, place.y, 0.0});
    if (!pixel || !view_.model().contains(*pixel)) return std::nullopt;
    const ImageSize size = view_.model().size();
    const bool isInside = pixel->u > kBorder && pixel->v > kBorder &&
                          pixel->u < size.width - kBorder && pixel->v < size.height - kBorder;
    return isInside ? pixel : std::nullopt;
  }

 private:
  const CameraView& view_;
  Pose2 fieldInSensor_;
  double range_;
};

/// Whether an arc is a filled spot.
bool isMark(const FieldLine& line) {
  return line.shape == FieldLine::Shape::kArc &&
         line.width >= 2.0 * std::min(line.radiusX, line.radiusY) * 0.999;
}

/// Counts a spot if it should be in sight. The finder of lines need not have found it.
void countMark(const FieldLine& mark, const Sight& sight, const FloorMask& floor,
               LinesInSight& seen) {
  const auto at = sight.pixelOf({mark.x, mark.y});
  const auto edge = sight.pixelOf({mark.x + mark.radiusX, mark.y});
  const auto side = sight.pixelOf({mark.x, mark.y + mark.radiusX});
  if (!floor.isKnown() || !at || !edge || !side) return;
  const double radius = std::max(std::hypot(edge->u - at->u, edge->v - at->v),
                                 std::hypot(side->u - at->u, side->v - at->v));
  if (radius < kLeastMark) return;
  bool isBare = true;
  const double around = std::max(kAcross, 1.5 * radius);
  for (double v = -around; v <= around; v += 2.0)
    for (double u = -around; u <= around; u += 2.0)
      isBare = isBare && floor.isFloor({at->u + u, at->v + v});
  ++(isBare ? seen.marksMissing : seen.marksFound);
}

bool isFound(std::span<const LinePoint> points, const Pixel& at, const Pixel& ahead,
             double halfWidth) {
  const double length = std::max(1e-9, std::hypot(ahead.u - at.u, ahead.v - at.v));
  const double du = (ahead.u - at.u) / length;
  const double dv = (ahead.v - at.v) / length;
  const double mostAcross = std::max(kAcross, 2.0 * kAcrossShare * halfWidth);
  // Near the camera, a step along the line is more than the distance between scan lines.
  const double mostAlong = std::max(kAlong, length);
  return std::any_of(points.begin(), points.end(), [&](const LinePoint& p) {
    const double u = p.pixel.u - at.u;
    const double v = p.pixel.v - at.v;
    return std::abs(u * du + v * dv) <= mostAlong && std::abs(u * dv - v * du) <= mostAcross;
  });
}

}  // namespace

LinesInSight linesInSight(const FieldLines& field, const CameraView& view,
                          const Pose2& sensorInField, std::span<const LinePoint> points,
                          const FloorMask& floor, double range) {
  LinesInSight seen;
  const Sight sight(view, sensorInField, range);
  for (const FieldLine& line : field.lines()) {
    if (isMark(line)) {
      countMark(line, sight, floor, seen);
      continue;
    }
    eachPiece(line, [&](const Piece& piece) {
      const auto at = sight.pixelOf(piece.middle);
      const auto ahead = sight.pixelOf(piece.ahead);
      const auto edge = sight.pixelOf(piece.edge);
      if (!at || !ahead || !edge) return;
      const double halfWidth = std::hypot(edge->u - at->u, edge->v - at->v);
      if (2.0 * halfWidth < kLeastWidth) return;
      if (isFound(points, *at, *ahead, halfWidth))
        seen.found += kStep;
      else if (!floor.isKnown() || floor.isFloor(*at))
        seen.missing += kStep;
      else
        seen.hidden += kStep;
    });
  }
  return seen;
}

}  // namespace ortung
