#include <cmath>

#include "Distortion.hpp"
#include "Models.hpp"
#include "TomlText.hpp"

namespace ortung {
namespace {

constexpr double kFarthest = 57.3;

/// Mirrors and fisheyes as a projection from a unit sphere, seen from @p xi behind its middle
/// (Mei and Rives, "Single view point omnidirectional camera calibration from planar grids", ICRA
/// 2007; Geyer and Daniilidis 2000): xi is 0 for a plain lens, 1 for a parabolic mirror, in between
/// for hyperbolic ones.
class UnifiedModel : public CameraModel {
 public:
  explicit UnifiedModel(const Parameters& p)
      : CameraModel(readCommon(p)),
        xi_(p.number("xi", {0.0, 10.0})),
        focal_(p.numbers("focal_px", 2, {1.0, 1e6})),
        skew_(p.numberOr("skew_px", 0.0, {-1e5, 1e5})),
        distortion_(p, kFarthest, 4) {
    // Beyond this height two points of the sphere share a pixel, or the plane ends.
    lowest_ = xi_ > 1.0 ? -1.0 / xi_ : -xi_;
  }

 private:
  std::optional<Pixel> toPixel(const Point3& point) const override {
    if (!(point.z > lowest_ + 1e-9)) return std::nullopt;
    const double depth = point.z + xi_;
    const auto p = distortion_.distort({point.x / depth, point.y / depth});
    if (!p) return std::nullopt;
    return Pixel{centre().u + focal_[0] * p->x + skew_ * p->y, centre().v + focal_[1] * p->y};
  }

  std::optional<Point3> toRay(const Pixel& pixel) const override {
    const double y = (pixel.v - centre().v) / focal_[1];
    const double x = (pixel.u - centre().u - skew_ * y) / focal_[0];
    const auto p = distortion_.undistort({x, y});
    if (!p) return std::nullopt;
    const double r2 = p->x * p->x + p->y * p->y;
    const double root = 1.0 + (1.0 - xi_ * xi_) * r2;
    if (!(root >= 0.0)) return std::nullopt;
    const double factor = (xi_ + std::sqrt(root)) / (1.0 + r2);
    if (!(factor - xi_ > lowest_)) return std::nullopt;
    return Point3{factor * p->x, factor * p->y, factor - xi_};
  }

  std::string ownToml() const override {
    std::string text = "model = \"unified\"\n" + tomlLine("xi", xi_) + tomlLine("focal_px", focal_);
    if (skew_ != 0.0) text += tomlLine("skew_px", skew_);
    if (!distortion_.coefficients().empty())
      text += tomlLine("distortion", distortion_.coefficients());
    return text;
  }

  double xi_;
  std::vector<double> focal_;
  double skew_;
  Distortion distortion_;
  double lowest_ = 0.0;  ///< z of a direction that is still shown
};

}  // namespace

std::shared_ptr<const CameraModel> makeUnified(const Parameters& camera) {
  return std::make_shared<UnifiedModel>(camera);
}

}  // namespace ortung
