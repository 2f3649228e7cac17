#include "Distortion.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>

#include "Inversion.hpp"

namespace ortung {

namespace {

/// Their number is checked before anything is made of them.
std::vector<double> readCoefficients(const Parameters& camera, std::size_t most) {
  std::vector<double> all = camera.numbersOr("distortion", {}, -1, {-1e4, 1e4});
  if (all.size() > most)
    camera.fail("distortion", "has " + std::to_string(all.size()) + " numbers, expected at most " +
                                  std::to_string(most) + ": k1, k2, p1, p2" +
                                  (most == 5 ? ", k3" : ""));
  return all;
}

}  // namespace

Distortion::Distortion(const Parameters& camera, double farthest, std::size_t most)
    : Distortion(readCoefficients(camera, most), farthest) {}

Distortion::Distortion(const std::vector<double>& coefficients, double farthest)
    : given_(coefficients) {
  double* const all[] = {&k1_, &k2_, &p1_, &p2_, &k3_};
  for (std::size_t i = 0; i < std::min(given_.size(), std::size(all)); ++i) *all[i] = given_[i];
  const auto along = [this](double r, double& slope) { return radial(r, slope); };
  mostRadius_ = endOfIncrease(along, farthest, 16384);
  double slope = 0.0;
  mostDistorted_ = radial(mostRadius_, slope);
}

double Distortion::radial(double r, double& slope) const {
  const double r2 = r * r;
  slope = 1.0 + r2 * (3.0 * k1_ + r2 * (5.0 * k2_ + r2 * 7.0 * k3_));
  return r * (1.0 + r2 * (k1_ + r2 * (k2_ + r2 * k3_)));
}

PlanePoint Distortion::apply(const PlanePoint& p) const {
  const double r2 = p.x * p.x + p.y * p.y;
  const double factor = 1.0 + r2 * (k1_ + r2 * (k2_ + r2 * k3_));
  return {p.x * factor + 2.0 * p1_ * p.x * p.y + p2_ * (r2 + 2.0 * p.x * p.x),
          p.y * factor + p1_ * (r2 + 2.0 * p.y * p.y) + 2.0 * p2_ * p.x * p.y};
}

std::optional<PlanePoint> Distortion::distort(const PlanePoint& p) const {
  if (!(std::hypot(p.x, p.y) <= mostRadius_)) return std::nullopt;
  return apply(p);
}

/// Inverts the radial part alone at first, then solves in the plane for the tangential part.
std::optional<PlanePoint> Distortion::undistort(const PlanePoint& p) const {
  const double distance = std::hypot(p.x, p.y);
  const bool isTangential = p1_ != 0.0 || p2_ != 0.0;
  // The tangential part may carry a point a little beyond the border.
  if (!(distance <= mostDistorted_ * (isTangential ? 1.1 : 1.0))) return std::nullopt;
  PlanePoint q = p;
  if (distance > 0.0) {
    const auto along = [this](double r, double& slope) { return radial(r, slope); };
    const double r =
        solveIncreasing(along, std::min(distance, mostDistorted_), 0.0, mostRadius_) / distance;
    q = {p.x * r, p.y * r};
  }
  return isTangential ? polish(q, p) : q;
}

/// Takes Newton's steps in the plane.
std::optional<PlanePoint> Distortion::polish(PlanePoint q, const PlanePoint& wanted) const {
  for (int i = 0; i < 30; ++i) {
    const double r2 = q.x * q.x + q.y * q.y;
    const double factor = 1.0 + r2 * (k1_ + r2 * (k2_ + r2 * k3_));
    const double change = 2.0 * (k1_ + r2 * (2.0 * k2_ + r2 * 3.0 * k3_));
    const double xx = factor + change * q.x * q.x + 2.0 * p1_ * q.y + 6.0 * p2_ * q.x;
    const double xy = change * q.x * q.y + 2.0 * p1_ * q.x + 2.0 * p2_ * q.y;
    const double yy = factor + change * q.y * q.y + 6.0 * p1_ * q.y + 2.0 * p2_ * q.x;
    const PlanePoint now = apply(q);
    const double dx = now.x - wanted.x;
    const double dy = now.y - wanted.y;
    const double determinant = xx * yy - xy * xy;
    const double stepX = (yy * dx - xy * dy) / determinant;
    const double stepY = (xx * dy - xy * dx) / determinant;
    q = {q.x - stepX, q.y - stepY};
    if (!(std::hypot(q.x, q.y) <= 2.0 * mostRadius_)) return std::nullopt;
    if (std::hypot(stepX, stepY) <= 1e-15 * (1.0 + std::hypot(q.x, q.y))) break;
  }
  const PlanePoint back = apply(q);
  if (!(std::hypot(back.x - wanted.x, back.y - wanted.y) <= 1e-10)) return std::nullopt;
  if (!(std::hypot(q.x, q.y) <= mostRadius_)) return std::nullopt;
  return q;
}

}  // namespace ortung
