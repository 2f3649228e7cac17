#include <cmath>

#include "Distortion.hpp"
#include "Models.hpp"
#include "TomlText.hpp"

namespace ortung {
namespace {

/// Greatest distance from the axis in the plane in front of the camera: 89 degrees.
constexpr double kFarthest = 57.3;

/// A lens that keeps straight lines straight, but for its distortion.
class PerspectiveModel : public CameraModel {
 public:
  explicit PerspectiveModel(const Parameters& p)
      : CameraModel(readCommon(p)),
        focal_(p.numbers("focal_px", 2, {1.0, 1e6})),
        distortion_(p, kFarthest) {}

 private:
  std::optional<Pixel> toPixel(const Point3& point) const override {
    if (!(point.z > 1e-9)) return std::nullopt;
    const auto p = distortion_.distort({point.x / point.z, point.y / point.z});
    if (!p) return std::nullopt;
    return Pixel{centre().u + focal_[0] * p->x, centre().v + focal_[1] * p->y};
  }

  std::optional<Point3> toRay(const Pixel& pixel) const override {
    const auto p = distortion_.undistort(
        {(pixel.u - centre().u) / focal_[0], (pixel.v - centre().v) / focal_[1]});
    if (!p) return std::nullopt;
    return Point3{p->x, p->y, 1.0};
  }

  std::string ownToml() const override {
    std::string text = "model = \"perspective\"\n" + tomlLine("focal_px", focal_);
    if (!distortion_.coefficients().empty())
      text += tomlLine("distortion", distortion_.coefficients());
    return text;
  }

  std::vector<double> focal_;
  Distortion distortion_;
};

/// The mirror of the paper's Fig. 5 (a): under it the floor appears to scale, as in a perspective
/// image of a camera that looks straight down. (Hicks and Bajcsy, "Catadioptric sensors that
/// approximate wide-angle perspective projections", CVPR 2000.)
class IsometricModel : public CameraModel {
 public:
  explicit IsometricModel(const Parameters& p)
      : CameraModel(readCommon(p)),
        scale_(p.number("pixels_per_m", {0.01, 1e5})),
        height_(p.number("height_m", {0.01, 100.0})) {}

 private:
  std::optional<Pixel> toPixel(const Point3& point) const override {
    if (!(point.z > 1e-6)) return std::nullopt;
    const double f = scale_ * height_;
    return Pixel{centre().u + f * point.x / point.z, centre().v + f * point.y / point.z};
  }

  std::optional<Point3> toRay(const Pixel& pixel) const override {
    const double f = scale_ * height_;
    return Point3{pixel.u - centre().u, pixel.v - centre().v, f};
  }

  std::string ownToml() const override {
    return "model = \"isometric\"\n" + tomlLine("pixels_per_m", scale_) +
           tomlLine("height_m", height_);
  }

  double scale_;   ///< resolution on the floor [px/m]
  double height_;  ///< height of the viewpoint above the floor [m]
};

}  // namespace

std::shared_ptr<const CameraModel> makePerspective(const Parameters& camera) {
  return std::make_shared<PerspectiveModel>(camera);
}

std::shared_ptr<const CameraModel> makeIsometric(const Parameters& camera) {
  return std::make_shared<IsometricModel>(camera);
}

}  // namespace ortung
