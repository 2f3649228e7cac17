/// Our models beside OpenCV's, and beside a paper's formulas where those need more of OpenCV.
#include <gtest/gtest.h>

#include <opencv2/calib3d.hpp>

#include "Cameras.hpp"
#include "ortung/base/Random.hpp"

namespace ortung {
namespace {

std::vector<cv::Point3d> pointsInFront(double mostSide) {
  Random random(11);
  std::vector<cv::Point3d> points;
  for (int i = 0; i < 10000; ++i)
    points.emplace_back((random.uniform() - 0.5) * 2.0 * mostSide,
                        (random.uniform() - 0.5) * 2.0 * mostSide, 0.5 + random.uniform());
  return points;
}

void expectSame(const CameraModel& camera, const std::vector<cv::Point3d>& points,
                const std::vector<cv::Point2d>& pixels) {
  int seen = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto pixel = camera.project({points[i].x, points[i].y, points[i].z});
    if (!pixel) continue;
    ++seen;
    EXPECT_NEAR(pixel->u, pixels[i].x, 1e-6);
    EXPECT_NEAR(pixel->v, pixels[i].y, 1e-6);
  }
  EXPECT_GT(seen, 9000);
}

const cv::Vec3d kNone(0.0, 0.0, 0.0);

TEST(CameraOracle, PerspectiveIsOpenCvs) {
  const auto points = pointsInFront(0.5);
  std::vector<cv::Point2d> pixels;
  const cv::Matx33d k(420.0, 0.0, 322.5, 0.0, 425.0, 236.25, 0.0, 0.0, 1.0);
  cv::projectPoints(points, kNone, kNone, k,
                    cv::Vec<double, 5>(-0.21, 0.08, 0.0012, -0.0009, -0.012), pixels);
  expectSame(*cameraOf(kPerspective), points, pixels);
}

TEST(CameraOracle, FisheyeIsOpenCvs) {
  const auto points = pointsInFront(2.0);
  std::vector<cv::Point2d> pixels;
  const cv::Matx33d k(330.0, 0.0, 301.0, 0.0, 331.5, 405.0, 0.0, 0.0, 1.0);
  cv::fisheye::projectPoints(points, pixels, cv::Affine3d::Identity(), k,
                             cv::Vec4d(-0.03, 0.012, -0.006, 0.0008));
  expectSame(*cameraOf(kFisheye), points, pixels);
}

/// Mei and Rives, "Single view point omnidirectional camera calibration from planar grids" (ICRA
/// 2007), section II: the unit sphere, its projection from xi, distortion, and the matrix K.
cv::Point2d projectLikeMei(const cv::Point3d& point, double xi, const cv::Vec4d& kp,
                           const cv::Matx33d& k) {
  const cv::Point3d onSphere = point / cv::norm(point);
  const double x = onSphere.x / (onSphere.z + xi);
  const double y = onSphere.y / (onSphere.z + xi);
  const double rho2 = x * x + y * y;
  const double radial = kp[0] * rho2 + kp[1] * rho2 * rho2;
  const double dx = x * radial + 2.0 * kp[2] * x * y + kp[3] * (rho2 + 2.0 * x * x);
  const double dy = y * radial + kp[2] * (rho2 + 2.0 * y * y) + 2.0 * kp[3] * x * y;
  const cv::Vec3d p = k * cv::Vec3d(x + dx, y + dy, 1.0);
  return {p[0], p[1]};
}

TEST(CameraOracle, UnifiedIsMeis) {
  const auto points = pointsInFront(2.0);
  std::vector<cv::Point2d> pixels;
  const cv::Matx33d k(210.0, 0.4, 240.5, 0.0, 211.0, 238.0, 0.0, 0.0, 1.0);
  for (const cv::Point3d& point : points)
    pixels.push_back(projectLikeMei(point, 0.93, {-0.05, 0.01, 0.0004, -0.0006}, k));
  expectSame(*cameraOf(kUnified), points, pixels);
}

}  // namespace
}  // namespace ortung
