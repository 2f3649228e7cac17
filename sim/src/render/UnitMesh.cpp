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
    mesh_.first[shape_] = static_cast<std::uint32_t>(mesh_.vertices.size());
  }
  void end() {
    mesh_.count[shape_] = static_cast<std::uint32_t>(mesh_.vertices.size()) - mesh_.first[shape_];
  }
  /// Adds a triangle, counter-clockwise seen from outside.
  void triangle(const WallVertex& a, const WallVertex& b, const WallVertex& c) {
    mesh_.vertices.insert(mesh_.vertices.end(), {a, b, c});
  }
  void quad(const WallVertex& a, const WallVertex& b, const WallVertex& c, const WallVertex& d) {
    triangle(a, b, c);
    triangle(a, c, d);
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
      const Vector na = isSmooth ? Vector{a[0], a[1], 0.0F} : flat;
      const Vector nb = isSmooth ? Vector{b[0], b[1], 0.0F} : flat;
      quad({{a[0], a[1], 0.0F}, na}, {{b[0], b[1], 0.0F}, nb}, {{b[0], b[1], 1.0F}, nb},
           {{a[0], a[1], 1.0F}, na});
    }
    for (std::size_t i = 2; i < n; ++i) {
      const auto& a = corners[0];
      const auto& b = corners[i - 1];
      const auto& c = corners[i];
      constexpr Vector kUp{0.0F, 0.0F, 1.0F};
      constexpr Vector kDown{0.0F, 0.0F, -1.0F};
      triangle({{a[0], a[1], 1.0F}, kUp}, {{b[0], b[1], 1.0F}, kUp}, {{c[0], c[1], 1.0F}, kUp});
      triangle({{a[0], a[1], 0.0F}, kDown}, {{c[0], c[1], 0.0F}, kDown},
               {{b[0], b[1], 0.0F}, kDown});
    }
  }
  void ball() {
    const auto at = [](int ring, int corner) {
      const double polar = std::acos(-1.0) * ring / kRings;
      const double turn = kTurn * corner / (2 * kRings);
      const auto x = static_cast<float>(std::sin(polar) * std::cos(turn));
      const auto y = static_cast<float>(std::sin(polar) * std::sin(turn));
      const auto z = static_cast<float>(-std::cos(polar));
      // The gradient of the ellipsoid, whose half axis along z is a half.
      return WallVertex{{x, y, 0.5F + 0.5F * z}, {x, y, 2.0F * z}};
    };
    for (int ring = 0; ring < kRings; ++ring)
      for (int corner = 0; corner < 2 * kRings; ++corner)
        quad(at(ring, corner), at(ring, corner + 1), at(ring + 1, corner + 1),
             at(ring + 1, corner));
  }

 private:
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
