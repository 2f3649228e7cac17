#include "LineLook.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "ortung/vision/FloorSight.hpp"

namespace ortung::app {
namespace {

/// Draws the field's lines where the camera would see them.
void drawField(Picture& picture, const FieldLines& field, const CameraView& view,
               const Pose2& pose) {
  const auto dot = [&](double x, double y) {
    const Pose2 place = inverse(pose) * Pose2{x, y, 0.0};
    if (const auto pixel = view.pixelOf({place.x, place.y, 0.0})) picture.dot(*pixel, 0, 0, 0, 255);
  };
  constexpr double kStep = 0.02;  // distance between drawn points [m]
  for (const FieldLine& line : field.lines()) {
    if (line.shape == FieldLine::Shape::kStraight) {
      const double length = std::hypot(line.x1 - line.x0, line.y1 - line.y0);
      for (double d = 0.0; d <= length; d += kStep)
        dot(line.x0 + (line.x1 - line.x0) * d / length, line.y0 + (line.y1 - line.y0) * d / length);
      continue;
    }
    const double c = std::cos(line.angle);
    const double s = std::sin(line.angle);
    const double step = kStep / std::max(line.radiusX, line.radiusY);
    for (double t = line.from; t <= line.to; t += step) {
      const double x = line.radiusX * std::cos(t);
      const double y = line.radiusY * std::sin(t);
      dot(line.x + c * x - s * y, line.y + s * x + c * y);
    }
  }
}

}  // namespace

Look lookAt(const std::filesystem::path& file) {
  Look look{readPicture(file), {}};
  const ImageView view = look.picture.view();
  const ColourTable colours(findColours({&view, 1}));
  LineFinder finder({});
  const auto points = finder.find(view, colours);
  look.lines = {{points.begin(), points.end()}, floorTopOf(view, colours), {view, colours}};
  return look;
}

std::vector<Look> lookAtAll(const std::vector<std::filesystem::path>& files) {
  std::vector<Look> looks;
  for (const std::filesystem::path& file : files) {
    looks.push_back(lookAt(file));
    if (!(looks.back().picture.size == looks.front().picture.size))
      throw std::runtime_error(
          fmt::format("{}: has another size than {}, so it is of another camera", file.string(),
                      files.front().string()));
  }
  return looks;
}

void draw(Look& look, const FieldLines& field, const CameraView& view, const Pose2& pose) {
  drawField(look.picture, field, view, pose);
  for (const LinePoint& point : look.lines.points) look.picture.dot(point.pixel, 1, 255, 0, 0);
}

}  // namespace ortung::app
