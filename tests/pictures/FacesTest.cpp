// The perspective faces that pictures are made of: which pixels they show, and what lies in their
// view.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "Cameras.hpp"
#include "Faces.hpp"
#include "ortung/base/Random.hpp"
#include "render/FaceView.hpp"

namespace ortung::test {
namespace {

const std::string kPlain = "model = \"perspective\"\nsize_px = [12, 9]\nfocal_px = [10.0, 11.0]\n";
const std::string kAllAround =
    "model = \"unified\"\nsize_px = [60, 60]\nxi = 0.95\nfocal_px = [23.0, 23.0]\ninner_px = 4\n"
    "outer_px = 29\n";

using Vector = std::array<double, 3>;

/// The product of a matrix, row by row, and a vector.
Vector times(const std::array<double, 9>& m, const Vector& v) {
  Vector sum{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) sum[i] += m[3 * i + k] * v[k];
  return sum;
}

/// A direction of the camera in a face's frame.
Vector onFace(const SheetFace& face, const Point3& r) {
  const std::array<double, 9>& m = face.inCamera;
  return times({m[0], m[3], m[6], m[1], m[4], m[7], m[2], m[5], m[8]}, {r.x, r.y, r.z});
}

TEST(Faces, APlainPictureIsAFaceAndOneBentPixelAnywhereMakesItNone) {
  const PixelRays rays(*cameraOf(kPlain));
  const auto face = plainFace(rays);
  ASSERT_TRUE(face);
  EXPECT_EQ(face->width, 12);
  EXPECT_EQ(face->height, 9);
  EXPECT_NEAR(face->right - face->left, 12 / 10.0, 1e-12);
  EXPECT_NEAR(face->bottom - face->top, 9 / 11.0, 1e-12);
  for (std::size_t i = 0; i < rays.rays.size(); ++i) {
    for (const bool alongX : {true, false}) {
      PixelRays bent = rays;
      (alongX ? bent.rays[i].x : bent.rays[i].y) += 1e-4;
      EXPECT_FALSE(plainFace(bent)) << i << " " << alongX;
    }
    PixelRays blind = rays;
    blind.rays[i] = {};
    EXPECT_FALSE(plainFace(blind)) << i;
  }
}

TEST(Faces, EachPixelThatSeesSomethingIsOnOneOfThem) {
  for (const std::string& camera : {kPlain, kAllAround}) {
    const PixelRays rays(*cameraOf(camera));
    std::vector<int> shown(rays.rays.size());
    for (const FacePart& part : facesFor(rays)) {
      for (const std::uint32_t pixel : part.pixels) {
        ++shown[pixel];
        const auto [x, y, z] = onFace(part.face, rays.rays[pixel]);
        ASSERT_GT(z, 0.0) << pixel;
        EXPECT_GT(x / z, part.face.left) << pixel;
        EXPECT_LT(x / z, part.face.right) << pixel;
        EXPECT_GT(y / z, part.face.top) << pixel;
        EXPECT_LT(y / z, part.face.bottom) << pixel;
      }
    }
    for (std::size_t i = 0; i < shown.size(); ++i) EXPECT_EQ(shown[i], rays.isSeen(i) ? 1 : 0) << i;
  }
}

/// Turned about all axes.
std::array<double, 9> turned(Random& random) {
  std::array<double, 9> axes{1, 0, 0, 0, 1, 0, 0, 0, 1};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double angle = random.uniform(-std::numbers::pi, std::numbers::pi);
    const std::size_t a = (axis + 1) % 3;
    const std::size_t b = (axis + 2) % 3;
    for (std::size_t row = 0; row < 3; ++row) {
      const double x = axes[3 * row + a];
      const double y = axes[3 * row + b];
      axes[3 * row + a] = std::cos(angle) * x - std::sin(angle) * y;
      axes[3 * row + b] = std::sin(angle) * x + std::cos(angle) * y;
    }
  }
  return axes;
}

// A sphere on the border of the view is seen until it has left it whole: through a side, or
// backwards where the sides of a narrow view meet.
TEST(FaceView, SeesASphereUntilItHasLeftTheView) {
  Random random(5);
  for (int i = 0; i < 500; ++i) {
    CameraPose camera;
    camera.axes = turned(random);
    SheetFace face;
    face.inCamera = turned(random);
    face.left = random.uniform(-1.5, 0.3);
    face.right = face.left + random.uniform(0.1, 1.5);
    face.top = random.uniform(-1.5, 0.3);
    face.bottom = face.top + random.uniform(0.1, 1.5);
    const FaceView view(camera, face);
    const auto sees = [&](const Vector& p, double reach) {
      const Vector relative = times(camera.axes, times(face.inCamera, p));
      return view.sees(relative[0], relative[1], relative[2], reach);
    };
    const double depth = random.uniform(0.5, 5.0);
    const double x = random.uniform(face.left, face.right);
    const double y = random.uniform(face.top, face.bottom);
    EXPECT_TRUE(sees({depth * x, depth * y, depth}, 0.0)) << i;
    const double reach = random.uniform(0.0, 0.2);
    const auto expectBorder = [&](const Vector& border, const Vector& outwards) {
      const double length = std::hypot(outwards[0], outwards[1], outwards[2]);
      for (const auto& [share, isSeen] : {std::pair{0.999, true}, {1.001, false}}) {
        const double by = share * (reach + 1e-6) / length;
        EXPECT_EQ(sees({border[0] + by * outwards[0], border[1] + by * outwards[1],
                        border[2] + by * outwards[2]},
                       reach + 1e-6),
                  isSeen)
            << i << " " << share;
      }
    };
    expectBorder({depth * face.left, depth * y, depth}, {-1.0, 0.0, face.left});
    expectBorder({depth * face.right, depth * y, depth}, {1.0, 0.0, -face.right});
    expectBorder({depth * x, depth * face.top, depth}, {0.0, -1.0, face.top});
    expectBorder({depth * x, depth * face.bottom, depth}, {0.0, 1.0, -face.bottom});
    EXPECT_FALSE(sees({0.0, 0.0, -1.001 * reach - 1e-9}, reach)) << i << " behind";
    Vector within{};
    for (double& part : within) part = random.uniform(-0.5, 0.5) * reach;
    EXPECT_TRUE(sees(within, reach)) << i << " around the camera";
  }
}

}  // namespace
}  // namespace ortung::test
