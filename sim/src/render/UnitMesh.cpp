#include <cmath>

#include "StandingScene.hpp"
#include "ortung/base/Angles.hpp"

namespace ortung {
namespace {

constexpr int kCorners = 40;  ///< corners of a circle, whose edge is off by 0.3 % of the radius
constexpr int kRings = 14;    ///< rings of a ball

using Vector = std::array<float, 3>;

class Shapes {
 public:
  explicit Shapes(UnitMesh& mesh) : mesh_(mesh) {}

  void begin(UnitShape shape) {
    shape_ = static_cast<std::size_t>(shape);
    mesh_.first[shape_] = static_cast<std::uint32_t>(mesh_.corners.size());
  }
  void end() {
    mesh_.count[shape_] = static_cast<std::uint32_t>(mesh_.corners.size()) - mesh_.first[shape_];
  }
  /// Adds an upright prism over a polygon in counter-clockwise order.
  /// @param isSmooth whether normals are those of a circle
  void prism(const std::vector<std::array<float, 2>>& corners, bool isSmooth) {
    const std::size_t n = corners.size();
    for (std::size_t i = 0; i < n; ++i) {
      const auto& a = corners[i];
      const auto& b = corners[(i + 1) % n];
      const float length = std::hypot(b[0] - a[0], b[1] - a[1]);
      const Vector flat{(b[1] - a[1]) / length, (a[0] - b[0]) / length, 0.0F};
      const Corner from = side(a, isSmooth ? Vector{a[0], a[1], 0.0F} : flat);
      const Corner to = side(b, isSmooth ? Vector{b[0], b[1], 0.0F} : flat);
      quad(from, to, static_cast<Corner>(to + 1), static_cast<Corner>(from + 1));
    }
    for (const float z : {1.0F, 0.0F}) {
      std::vector<Corner> rim;
      for (const auto& a : corners) rim.push_back(vertex({a[0], a[1], z}, {0, 0, 2.0F * z - 1.0F}));
      for (std::size_t i = 2; i < n; ++i)
        triangle(rim[0], rim[z > 0.0F ? i - 1 : i], rim[z > 0.0F ? i : i - 1]);
    }
  }
  void ball() {
    const auto at = [this](int ring, int corner) {
      const double polar = std::acos(-1.0) * ring / kRings;
      const double turn = kTurn * corner / (2 * kRings);
      const auto x = static_cast<float>(std::sin(polar) * std::cos(turn));
      const auto y = static_cast<float>(std::sin(polar) * std::sin(turn));
      const auto z = static_cast<float>(-std::cos(polar));
      // The gradient of the ellipsoid, whose half axis along z is a half.
      return vertex({x, y, 0.5F + 0.5F * z}, {x, y, 2.0F * z});
    };
    std::vector<Corner> below, ring;
    for (int i = 0; i <= kRings; ++i, std::swap(below, ring)) {
      ring.clear();
      for (int corner = 0; corner < 2 * kRings; ++corner) ring.push_back(at(i, corner));
      for (std::size_t k = 0; i > 0 && k < ring.size(); ++k) {
        const std::size_t next = (k + 1) % ring.size();
        quad(below[k], below[next], ring[next], ring[k]);
      }
    }
  }

 private:
  using Corner = std::uint16_t;

  Corner vertex(const Vector& place, const Vector& normal) {
    mesh_.vertices.push_back({place, normal});
    return static_cast<Corner>(mesh_.vertices.size() - 1);
  }
  /// Adds the lower and the upper end of an upright edge. @returns the lower; the upper is the next
  Corner side(const std::array<float, 2>& at, const Vector& normal) {
    const Corner lower = vertex({at[0], at[1], 0.0F}, normal);
    vertex({at[0], at[1], 1.0F}, normal);
    return lower;
  }
  /// Adds a triangle, counter-clockwise seen from outside.
  void triangle(Corner a, Corner b, Corner c) {
    mesh_.corners.insert(mesh_.corners.end(), {a, b, c});
  }
  void quad(Corner a, Corner b, Corner c, Corner d) {
    triangle(a, b, c);
    triangle(a, c, d);
  }

  UnitMesh& mesh_;
  std::size_t shape_ = 0;
};

}  // namespace

UnitMesh unitMesh() {
  UnitMesh mesh;
  Shapes shapes(mesh);
  shapes.begin(UnitShape::kBox);
  shapes.prism({{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, false);
  shapes.end();
  shapes.begin(UnitShape::kCylinder);
  // The corners are as far outside the circle as the edges are inside.
  const double radius = 2.0 / (1.0 + std::cos(kTurn / (2 * kCorners)));
  std::vector<std::array<float, 2>> circle;
  for (int i = 0; i < kCorners; ++i)
    circle.push_back({static_cast<float>(radius * std::cos(kTurn * i / kCorners)),
                      static_cast<float>(radius * std::sin(kTurn * i / kCorners))});
  shapes.prism(circle, true);
  shapes.end();
  shapes.begin(UnitShape::kPrism);
  shapes.prism({{0, 0}, {1, 0}, {0, 1}}, false);
  shapes.end();
  shapes.begin(UnitShape::kBall);
  shapes.ball();
  shapes.end();
  return mesh;
}

}  // namespace ortung
