#include <cmath>
#include <numbers>

#include "Inversion.hpp"
#include "Models.hpp"
#include "TomlText.hpp"

namespace ortung {
namespace {

/// Returns the distance from the centre [focal lengths] for an angle to the axis [rad], with its
/// derivative.
struct RadialPolynomial {
  std::vector<double> k;

  double operator()(double angle, double& slope) const {
    const double a2 = angle * angle;
    slope = 1.0 + a2 * (3.0 * k[0] + a2 * (5.0 * k[1] + a2 * (7.0 * k[2] + a2 * 9.0 * k[3])));
    return angle * (1.0 + a2 * (k[0] + a2 * (k[1] + a2 * (k[2] + a2 * k[3]))));
  }
};

/// Distance from the centre as a polynomial of the angle to the axis (Kannala and Brandt, "A
/// generic camera model and calibration method for conventional, wide-angle, and fish-eye lenses",
/// PAMI 2006; four coefficients, as cv::fisheye has them).
class FisheyeModel : public CameraModel {
 public:
  explicit FisheyeModel(const Parameters& p)
      : CameraModel(readCommon(p)),
        focal_(p.numbers("focal_px", 2, {1.0, 1e6})),
        radial_{p.numbersOr("distortion", {0.0, 0.0, 0.0, 0.0}, 4, {-1e4, 1e4})} {
    mostAngle_ = endOfIncrease(radial_, std::numbers::pi);
    double slope = 0.0;
    mostRadius_ = radial_(mostAngle_, slope);
  }

 private:
  std::optional<Pixel> toPixel(const Point3& point) const override {
    const double side = std::hypot(point.x, point.y);
    const double angle = std::atan2(side, point.z);
    if (angle > mostAngle_) return std::nullopt;
    double slope = 0.0;
    const double scale = side > 0.0 ? radial_(angle, slope) / side : 0.0;
    return Pixel{centre().u + focal_[0] * scale * point.x,
                 centre().v + focal_[1] * scale * point.y};
  }

  std::optional<Point3> toRay(const Pixel& pixel) const override {
    const double x = (pixel.u - centre().u) / focal_[0];
    const double y = (pixel.v - centre().v) / focal_[1];
    const double radius = std::hypot(x, y);
    if (radius > mostRadius_) return std::nullopt;
    if (radius == 0.0) return Point3{0.0, 0.0, 1.0};
    const double angle = solveIncreasing(radial_, radius, 0.0, mostAngle_);
    const double side = std::sin(angle) / radius;
    return Point3{x * side, y * side, std::cos(angle)};
  }

  std::string ownToml() const override {
    return "model = \"fisheye\"\n" + tomlLine("focal_px", focal_) +
           tomlLine("distortion", radial_.k);
  }

  std::vector<double> focal_;
  RadialPolynomial radial_;
  /// Greatest angle to the axis up to which the model is one to one [rad].
  double mostAngle_ = 0.0;
  double mostRadius_ = 0.0;  ///< radius in the image at mostAngle_ [focal lengths]
};

}  // namespace

std::shared_ptr<const CameraModel> makeFisheye(const Parameters& camera) {
  return std::make_shared<FisheyeModel>(camera);
}

}  // namespace ortung
