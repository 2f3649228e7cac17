#include "ortung/camera/CameraModel.hpp"

#include <cmath>

#include "Models.hpp"
#include "TomlText.hpp"

namespace ortung {
namespace {

double lengthOf(const Point3& p) { return std::sqrt(p.x * p.x + p.y * p.y + p.z * p.z); }

}  // namespace

CameraModel::~CameraModel() = default;

std::optional<Pixel> CameraModel::project(const Point3& point) const {
  const double length = lengthOf(point);
  if (!(length > 0.0) || !std::isfinite(length)) return std::nullopt;
  const double x = common_.isMirrored ? -point.x : point.x;
  const std::optional<Pixel> pixel = toPixel({x / length, point.y / length, point.z / length});
  if (!pixel || !shows(*pixel)) return std::nullopt;
  return pixel;
}

std::optional<Point3> CameraModel::unproject(const Pixel& pixel) const {
  if (!std::isfinite(pixel.u) || !std::isfinite(pixel.v) || !shows(pixel)) return std::nullopt;
  std::optional<Point3> ray = toRay(pixel);
  if (!ray) return std::nullopt;
  const double length = lengthOf(*ray);
  if (!(length > 0.0) || !std::isfinite(length)) return std::nullopt;
  *ray = {(common_.isMirrored ? -ray->x : ray->x) / length, ray->y / length, ray->z / length};
  return ray;
}

bool CameraModel::shows(const Pixel& pixel) const {
  if (common_.inner <= 0.0 && common_.outer <= 0.0) return true;
  const double distance = std::hypot(pixel.u - centre().u, pixel.v - centre().v);
  return distance >= common_.inner && (common_.outer <= 0.0 || distance <= common_.outer);
}

CameraModel::Common CameraModel::readCommon(const Parameters& camera) {
  Common common;
  const std::vector<double> size = camera.numbers("size_px", 2, {8.0, 8192.0});
  common.size = {static_cast<int>(size[0]), static_cast<int>(size[1])};
  if (common.size.width != size[0] || common.size.height != size[1])
    camera.fail("size_px", "must be two whole numbers, width and height");
  const std::vector<double> centre =
      camera.numbersOr("centre_px", {(size[0] - 1.0) / 2.0, (size[1] - 1.0) / 2.0}, 2, {-1e5, 1e5});
  common.centre = {centre[0], centre[1]};
  common.isMirrored = camera.flagOr("mirrored", false);
  common.inner = camera.numberOr("inner_px", 0.0, {0.0, 1e5});
  common.outer = camera.numberOr("outer_px", 0.0, {0.0, 1e5});
  if (common.outer > 0.0 && common.outer <= common.inner)
    camera.fail("outer_px", "must be more than inner_px");
  return common;
}

std::string CameraModel::toml() const {
  const Common& c = common_;
  std::string text = ownToml();
  text +=
      tomlLine("size_px", {static_cast<double>(c.size.width), static_cast<double>(c.size.height)});
  text += tomlLine("centre_px", {c.centre.u, c.centre.v});
  if (c.isMirrored) text += "mirrored = true\n";
  if (c.inner > 0.0) text += tomlLine("inner_px", c.inner);
  if (c.outer > 0.0) text += tomlLine("outer_px", c.outer);
  return text;
}

std::shared_ptr<const CameraModel> readCamera(const Parameters& camera) {
  const std::string model = camera.choiceOr(
      "model", "perspective", {"perspective", "fisheye", "unified", "ocam", "isometric", "table"});
  if (model == "fisheye") return makeFisheye(camera);
  if (model == "unified") return makeUnified(camera);
  if (model == "ocam") return makeOcam(camera);
  if (model == "isometric") return makeIsometric(camera);
  if (model == "table") return makeTable(camera);
  return makePerspective(camera);
}

}  // namespace ortung
