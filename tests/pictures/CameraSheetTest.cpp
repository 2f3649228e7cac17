// How a camera's picture is put together from perspective ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ortung/pictures/CameraSheet.hpp"

namespace ortung {
namespace {

constexpr double kFocal = 4.0;  // [px]
constexpr Pixel kCentre{2.25, 1.5};

/// A perspective camera, but for one pixel that looks aside.
class BentCamera : public CameraModel {
 public:
  BentCamera(ImageSize size, Pixel bent, Point3 by)
      : CameraModel({.size = size, .centre = kCentre}), bent_(bent), by_(by) {}

 private:
  std::optional<Pixel> toPixel(const Point3& point) const override {
    return Pixel{kCentre.u + kFocal * point.x / point.z, kCentre.v + kFocal * point.y / point.z};
  }
  std::optional<Point3> toRay(const Pixel& pixel) const override {
    Point3 ray{(pixel.u - kCentre.u) / kFocal, (pixel.v - kCentre.v) / kFocal, 1.0};
    if (pixel.u == bent_.u && pixel.v == bent_.v) ray.x += by_.x, ray.y += by_.y;
    return ray;
  }
  std::string ownToml() const override { return ""; }

  Pixel bent_;
  Point3 by_;
};

/// A camera that looks in all directions: columns are angles around, rows angles from straight up.
class RoundCamera : public CameraModel {
 public:
  explicit RoundCamera(ImageSize size) : CameraModel({.size = size}) {}

 private:
  std::optional<Pixel> toPixel(const Point3&) const override { return std::nullopt; }
  std::optional<Point3> toRay(const Pixel& pixel) const override {
    const double around = 2.0 * std::numbers::pi * (pixel.u + 0.5) / size().width;
    const double down = std::numbers::pi * (pixel.v + 0.5) / size().height;
    return Point3{std::sin(down) * std::sin(around), -std::cos(down),
                  std::sin(down) * std::cos(around)};
  }
  std::string ownToml() const override { return ""; }
};

TEST(CameraSheet, OfAPerspectiveCameraIsItsPicture) {
  const CameraSheet sheet(BentCamera({6, 4}, {}, {}));
  EXPECT_TRUE(sheet.isPicture());
  EXPECT_EQ(sheet.size().width, 6);
  EXPECT_EQ(sheet.size().height, 4);
  ASSERT_EQ(sheet.faces().size(), 1u);
  const SheetFace& face = sheet.faces()[0];
  EXPECT_NEAR(face.left, (-0.5 - kCentre.u) / kFocal, 1e-12);
  EXPECT_NEAR(face.right, (5.5 - kCentre.u) / kFocal, 1e-12);
  EXPECT_NEAR(face.top, (-0.5 - kCentre.v) / kFocal, 1e-12);
  EXPECT_NEAR(face.bottom, (3.5 - kCentre.v) / kFocal, 1e-12);
}

TEST(CameraSheet, OfACameraOfWhichAnyPixelLooksAsideIsNotItsPicture) {
  for (int v = 0; v < 4; ++v)
    for (int u = 0; u < 6; ++u) {
      const Pixel pixel{static_cast<double>(u), static_cast<double>(v)};
      for (const Point3& by : {Point3{0.01, 0, 0}, Point3{0, -0.01, 0}})
        EXPECT_FALSE(CameraSheet(BentCamera({6, 4}, pixel, by)).isPicture()) << u << ", " << v;
    }
}

// Beyond 45 degrees a perspective picture has several texels for each of the camera's pixels, and
// another side of the cube around the camera needs fewer.
TEST(CameraSheet, OfAllDirectionsHasFacesThatReachHalfARightAngleAside) {
  const CameraSheet sheet(RoundCamera({400, 200}));
  EXPECT_FALSE(sheet.isPicture());
  double solidAngle = 0.0;
  for (const SheetFace& face : sheet.faces()) {
    const double margin = 4.0 * std::max((face.right - face.left) / face.width,
                                         (face.bottom - face.top) / face.height);
    EXPECT_GE(face.left, -1.0 - margin);
    EXPECT_GE(face.top, -1.0 - margin);
    EXPECT_LE(face.right, 1.0 + margin);
    EXPECT_LE(face.bottom, 1.0 + margin);
    // Of a rectangle in the plane z = 1, from the angles at its corners.
    const auto corner = [](double x, double y) {
      return std::atan2(x * y, std::sqrt(1.0 + x * x + y * y));
    };
    solidAngle += corner(face.right, face.bottom) - corner(face.left, face.bottom) -
                  corner(face.right, face.top) + corner(face.left, face.top);
  }
  EXPECT_GT(solidAngle, 0.99 * 4.0 * std::numbers::pi) << "they leave nothing out";
  EXPECT_LT(solidAngle, 1.5 * 4.0 * std::numbers::pi) << "they hardly overlap";
}

}  // namespace
}  // namespace ortung
