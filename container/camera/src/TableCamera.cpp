#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "Models.hpp"
#include "TomlText.hpp"

namespace ortung {
namespace {

/// Floor points farther away than this mean that no floor is in sight there [m].
constexpr double kNoFloor = 1000.0;

double dot(const Point3& a, const Point3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Point3 cross(const Point3& a, const Point3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Directions on a coarse grid of pixels, given by the floor points that they show: for mirrors
/// that no formula describes. Between the grid's pixels directions are interpolated.
class TableModel : public CameraModel {
 public:
  explicit TableModel(const Parameters& p)
      : CameraModel(readCommon(p)),
        height_(p.number("height_m", {0.01, 100.0})),
        grid_(p.numbers("grid", 2, {2.0, 1024.0})),
        floor_(p.numbers("floor_m", -1, {-1e9, 1e9})) {
    columns_ = static_cast<int>(grid_[0]);
    rows_ = static_cast<int>(grid_[1]);
    if (columns_ != grid_[0] || rows_ != grid_[1])
      p.fail("grid", "must be two whole numbers, columns and rows");
    const auto nodes = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
    if (floor_.size() != 2 * nodes)
      p.fail("floor_m", "has " + std::to_string(floor_.size()) + " numbers, expected " +
                            std::to_string(2 * nodes) + ": x, y of each pixel of the grid");
    stepU_ = (size().width - 1.0) / (columns_ - 1);
    stepV_ = (size().height - 1.0) / (rows_ - 1);
    for (std::size_t i = 0; i < nodes; ++i)
      rays_.push_back(rayTo(floor_[2 * i], floor_[2 * i + 1]));
  }

 private:
  /// The camera looks straight down: forward is up in the image, left is left.
  Point3 rayTo(double forward, double left) const {
    if (std::abs(forward) >= kNoFloor || std::abs(left) >= kNoFloor) return {};
    const double length = std::sqrt(forward * forward + left * left + height_ * height_);
    return {-left / length, -forward / length, height_ / length};
  }

  const Point3& node(int column, int row) const {
    return rays_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                 static_cast<std::size_t>(column)];
  }

  /// The direction at a place of the grid and its slopes, or nothing if the cell shows no floor.
  struct Patch {
    Point3 ray, alongU, alongV;
  };
  std::optional<Patch> patchAt(double column, double row) const {
    const int i = std::clamp(static_cast<int>(std::floor(column)), 0, columns_ - 2);
    const int j = std::clamp(static_cast<int>(std::floor(row)), 0, rows_ - 2);
    const Point3 &a = node(i, j), &b = node(i + 1, j), &c = node(i, j + 1), &d = node(i + 1, j + 1);
    if (a.z == 0.0 || b.z == 0.0 || c.z == 0.0 || d.z == 0.0) return std::nullopt;
    const double s = column - i;
    const double t = row - j;
    const auto mix = [&](double Point3::* m) {
      const double top = a.*m + s * (b.*m - a.*m);
      const double bottom = c.*m + s * (d.*m - c.*m);
      return std::array<double, 3>{top + t * (bottom - top),
                                   (b.*m - a.*m) + t * ((d.*m - c.*m) - (b.*m - a.*m)),
                                   bottom - top};
    };
    const auto x = mix(&Point3::x), y = mix(&Point3::y), z = mix(&Point3::z);
    return Patch{{x[0], y[0], z[0]}, {x[1], y[1], z[1]}, {x[2], y[2], z[2]}};
  }

  /// Starts at the nearest node and takes Newton's steps over the grid.
  std::optional<Pixel> toPixel(const Point3& point) const override {
    const auto nearest = std::max_element(
        rays_.begin(), rays_.end(),
        [&](const Point3& a, const Point3& b) { return dot(a, point) < dot(b, point); });
    const auto index = static_cast<int>(nearest - rays_.begin());
    double column = std::clamp(index % columns_ + 0.01, 0.0, columns_ - 1.0);
    double row = std::clamp(index / columns_ + 0.01, 0.0, rows_ - 1.0);
    const Point3 some = std::abs(point.x) < 0.6 ? Point3{1, 0, 0} : Point3{0, 1, 0};
    const Point3 e1 = cross(point, some);
    const Point3 e2 = cross(point, e1);
    for (int i = 0; i < 60; ++i) {
      const std::optional<Patch> p = patchAt(column, row);
      if (!p) return std::nullopt;
      const double f1 = dot(e1, p->ray), f2 = dot(e2, p->ray);
      const double a = dot(e1, p->alongU), b = dot(e1, p->alongV);
      const double c = dot(e2, p->alongU), d = dot(e2, p->alongV);
      const double determinant = a * d - b * c;
      if (!(std::abs(determinant) > 1e-300)) return std::nullopt;
      const double stepColumn = (d * f1 - b * f2) / determinant;
      const double stepRow = (a * f2 - c * f1) / determinant;
      column = std::clamp(column - std::clamp(stepColumn, -2.0, 2.0), -0.5, columns_ - 0.5);
      row = std::clamp(row - std::clamp(stepRow, -2.0, 2.0), -0.5, rows_ - 0.5);
      if (std::abs(stepColumn) + std::abs(stepRow) < 1e-11)
        return Pixel{column * stepU_, row * stepV_};
    }
    return std::nullopt;
  }

  std::optional<Point3> toRay(const Pixel& pixel) const override {
    const double column = pixel.u / stepU_;
    const double row = pixel.v / stepV_;
    if (!(column >= -0.5 && column <= columns_ - 0.5 && row >= -0.5 && row <= rows_ - 0.5))
      return std::nullopt;
    const std::optional<Patch> p = patchAt(column, row);
    return p ? std::optional(p->ray) : std::nullopt;
  }

  std::string ownToml() const override {
    return "model = \"table\"\n" + tomlLine("height_m", height_) + tomlLine("grid", grid_) +
           tomlLine("floor_m", floor_);
  }

  double height_;             ///< height of the viewpoint above the floor [m]
  std::vector<double> grid_;  ///< columns, rows
  std::vector<double> floor_;
  int columns_ = 0;
  int rows_ = 0;
  double stepU_ = 1.0;  ///< distance between columns [px]
  double stepV_ = 1.0;
  std::vector<Point3> rays_;  ///< row by row, in the camera's frame; z = 0: no floor
};

}  // namespace

std::shared_ptr<const CameraModel> makeTable(const Parameters& camera) {
  return std::make_shared<TableModel>(camera);
}

}  // namespace ortung
