// The perspective faces that pictures are made of: which pixels they show.
#include <gtest/gtest.h>

#include <cmath>

#include "Cameras.hpp"
#include "Faces.hpp"

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

}  // namespace
}  // namespace ortung::test
