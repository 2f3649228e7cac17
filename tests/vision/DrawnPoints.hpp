#pragma once

#include <cmath>
#include <functional>

#include "ortung/base/Random.hpp"
#include "ortung/calibration/LineCalibration.hpp"

namespace ortung {

/// What a perfect detector would find, but for noise of the pixels.
struct PerfectDetector {
  double noise = 0.5;              ///< standard deviation [px]
  double spacing = 0.1;            ///< distance between points along lines [m]
  double least = 0.0, most = 9.0;  ///< ranges of points [m]
  /// Which lines are painted, by their index; nothing: all.
  std::function<bool(std::size_t)> isPainted = {};

  LinePicture operator()(const FieldLines& field, const CameraView& view, const Pose2& pose,
                         Random& random) const {
    LinePicture picture;
    picture.floorTop = view.model().size().height;
    const auto add = [&](double x, double y) {
      const Pose2 place = inverse(pose) * Pose2{x, y, 0.0};
      const double range = std::hypot(place.x, place.y);
      if (range < least || range > most) return;
      const auto pixel = view.pixelOf({place.x, place.y, 0.0});
      if (!pixel || !view.model().contains(*pixel)) return;
      const Pixel seen{pixel->u + random.gaussian() * noise, pixel->v + random.gaussian() * noise};
      picture.points.push_back({seen, 5.0, true});
      picture.floorTop = std::min(picture.floorTop, seen.v);
    };
    for (std::size_t i = 0; i < field.lines().size(); ++i) {
      if (isPainted && !isPainted(i)) continue;
      const FieldLine& line = field.lines()[i];
      if (line.shape == FieldLine::Shape::kStraight) {
        const double length = std::hypot(line.x1 - line.x0, line.y1 - line.y0);
        for (double d = 0.0; d <= length; d += spacing)
          add(line.x0 + (line.x1 - line.x0) * d / length,
              line.y0 + (line.y1 - line.y0) * d / length);
      } else {
        for (double t = line.from; t <= line.to; t += spacing / line.radiusX)
          add(line.x + line.radiusX * std::cos(t), line.y + line.radiusX * std::sin(t));
      }
    }
    return picture;
  }
};

}  // namespace ortung
