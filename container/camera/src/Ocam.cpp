#include <algorithm>
#include <cmath>
#include <numbers>

#include "Inversion.hpp"
#include "Models.hpp"
#include "TomlText.hpp"

namespace ortung {
namespace {

double valueOf(const std::vector<double>& polynomial, double x) {
  double value = 0.0;
  for (std::size_t i = polynomial.size(); i-- > 0;) value = value * x + polynomial[i];
  return value;
}

/// Returns the angle to the axis of a point in sight at distance rho [px], with its derivative;
/// both times the polynomial's first coefficient, so that the derivative is about 1.
struct OcamAngle {
  const std::vector<double>& polynomial;

  double operator()(double rho, double& slope) const {
    double f = 0.0;
    double df = 0.0;
    for (std::size_t i = polynomial.size(); i-- > 0;) {
      df = df * rho + f;
      f = f * rho + polynomial[i];
    }
    slope = polynomial[0] * (f - rho * df) / (rho * rho + f * f);
    return polynomial[0] * std::atan2(rho, f);
  }
};

/// Direction of a pixel at distance rho from the centre: (x, y, f(rho)) with a polynomial f
/// (Scaramuzza, Martinelli and Siegwart, "A toolbox for easily calibrating omnidirectional
/// cameras", IROS 2006). Its z axis looks into the scene, so the polynomial begins with a positive
/// number: the toolbox's own with all signs turned.
class OcamModel : public CameraModel {
 public:
  explicit OcamModel(const Parameters& p)
      : CameraModel(readCommon(p)),
        polynomial_(p.numbers("polynomial", -1, {-1e9, 1e9})),
        affine_(p.numbersOr("affine", {1.0, 0.0, 0.0}, 3, {-10.0, 10.0})) {
    if (polynomial_.empty() || polynomial_.size() > 12 || !(polynomial_[0] > 0.0))
      p.fail("polynomial", "must have 1 to 12 numbers, the first of them positive");
    if (std::abs(affine_[0] - affine_[1] * affine_[2]) < 1e-6)
      p.fail("affine", "is [c, d, e] with c - d e = 0, which leaves no plane");
    const double corner =
        2.0 * std::hypot(size().width, size().height) + std::hypot(centre().u, centre().v);
    mostRho_ = endOfIncrease(OcamAngle{polynomial_}, corner, 16384);
    double slope = 0.0;
    mostAngle_ = OcamAngle{polynomial_}(mostRho_, slope);
  }

 private:
  std::optional<Pixel> toPixel(const Point3& point) const override {
    const double side = std::hypot(point.x, point.y);
    const double angle = std::atan2(side, point.z) * polynomial_[0];
    if (angle > mostAngle_) return std::nullopt;
    const double rho =
        side > 0.0 ? solveIncreasing(OcamAngle{polynomial_}, angle, 0.0, mostRho_) / side : 0.0;
    const double x = rho * point.x;
    const double y = rho * point.y;
    return Pixel{centre().u + affine_[0] * x + affine_[1] * y, centre().v + affine_[2] * x + y};
  }

  std::optional<Point3> toRay(const Pixel& pixel) const override {
    const double u = pixel.u - centre().u;
    const double v = pixel.v - centre().v;
    const double determinant = affine_[0] - affine_[1] * affine_[2];
    const double x = (u - affine_[1] * v) / determinant;
    const double y = (affine_[0] * v - affine_[2] * u) / determinant;
    const double rho = std::hypot(x, y);
    if (rho > mostRho_) return std::nullopt;
    return Point3{x, y, valueOf(polynomial_, rho)};
  }

  std::string ownToml() const override {
    return "model = \"ocam\"\n" + tomlLine("polynomial", polynomial_) + tomlLine("affine", affine_);
  }

  std::vector<double> polynomial_;
  std::vector<double> affine_;  ///< c, d, e: (u, v) = ((c, d), (e, 1)) (x, y)
  double mostRho_ = 0.0;        ///< [px]
  double mostAngle_ = 0.0;      ///< [rad], times the first coefficient
};

}  // namespace

std::shared_ptr<const CameraModel> makeOcam(const Parameters& camera) {
  return std::make_shared<OcamModel>(camera);
}

}  // namespace ortung
