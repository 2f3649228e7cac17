#include "ortung/camera/CameraView.hpp"

#include <cmath>
#include <stdexcept>

#include "TomlText.hpp"
#include "ortung/base/Angles.hpp"

namespace ortung {
namespace {

/// Level it looks along x, its own x axis to the right (-y) and its y axis down (-z); then the tilt
/// about its x axis and the roll about its z axis.
std::array<double, 9> axesOf(const CameraPlace& place) {
  const double c = std::cos(place.tilt);
  const double s = std::sin(place.tilt);
  const double x[3] = {0.0, -1.0, 0.0};
  const double y[3] = {-s, 0.0, -c};
  const double z[3] = {c, 0.0, -s};
  const double cr = std::cos(place.roll);
  const double sr = std::sin(place.roll);
  std::array<double, 9> axes{};
  for (std::size_t i = 0; i < 3; ++i) {
    axes[i] = cr * x[i] + sr * y[i];
    axes[3 + i] = cr * y[i] - sr * x[i];
    axes[6 + i] = z[i];
  }
  return axes;
}

}  // namespace

CameraView::CameraView(std::shared_ptr<const CameraModel> model, const CameraPlace& place)
    : model_(std::move(model)), place_(place), axes_(axesOf(place)) {
  if (!model_) throw std::invalid_argument("a camera's view needs a model of the camera");
}

std::optional<Pixel> CameraView::pixelOf(const Point3& p) const {
  const std::array<double, 9>& a = axes_;
  const double z = p.z - place_.z;
  return model_->project({a[0] * p.x + a[1] * p.y + a[2] * z, a[3] * p.x + a[4] * p.y + a[5] * z,
                          a[6] * p.x + a[7] * p.y + a[8] * z});
}

std::optional<Point3> CameraView::rayAt(const Pixel& pixel) const {
  const std::optional<Point3> r = model_->unproject(pixel);
  if (!r) return std::nullopt;
  const std::array<double, 9>& a = axes_;
  return Point3{a[0] * r->x + a[3] * r->y + a[6] * r->z, a[1] * r->x + a[4] * r->y + a[7] * r->z,
                a[2] * r->x + a[5] * r->y + a[8] * r->z};
}

std::optional<Point3> CameraView::floorAt(const Pixel& pixel, double z) const {
  const std::optional<Point3> ray = rayAt(pixel);
  if (!ray) return std::nullopt;
  const double way = (z - place_.z) / ray->z;
  if (!(way > 0.0) || !(way < 1e6)) return std::nullopt;
  return Point3{way * ray->x, way * ray->y, z};
}

CameraView readCameraView(const Parameters& camera, double z) {
  CameraPlace place;
  place.z = z;
  // Models that show the floor as a map look straight down.
  const std::string model = camera.textOr("model", "perspective");
  const double tilt = model == "isometric" || model == "table" ? 90.0 : 0.0;
  place.tilt = radians(camera.numberOr("tilt_deg", tilt, {-180.0, 180.0}));
  place.roll = radians(camera.numberOr("roll_deg", 0.0, {-180.0, 180.0}));
  return {readCamera(camera), place};
}

std::string toToml(const CameraView& view) {
  std::string text = view.model().toml();
  text += tomlLine("tilt_deg", degrees(view.place().tilt));
  if (view.place().roll != 0.0) text += tomlLine("roll_deg", degrees(view.place().roll));
  return text;
}

}  // namespace ortung
