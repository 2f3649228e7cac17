// Boards as cameras of known models see them, drawn pixel by pixel: what is found must be the
// model.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "ortung/base/Angles.hpp"
#include "ortung/base/Parameters.hpp"
#include "ortung/calibration/BoardCalibration.hpp"

namespace ortung {
namespace {

constexpr BoardSize kBoard{9, 6};

/// Where a board is: turned by angles about x, y and z, its middle at a place [squares].
struct Pose {
  double a, b, c;
  double x, y, z;
};

/// Columns of a rotation.
std::array<Point3, 3> axesOf(const Pose& p) {
  const double ca = std::cos(p.a), sa = std::sin(p.a), cb = std::cos(p.b), sb = std::sin(p.b),
               cc = std::cos(p.c), sc = std::sin(p.c);
  return {{{cb * cc, ca * sc + sa * sb * cc, sa * sc - ca * sb * cc},
           {-cb * sc, ca * cc - sa * sb * sc, sa * cc + ca * sb * sc},
           {sb, -sa * cb, ca * cb}}};
}

double dot(const Point3& a, const Point3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/// Brightness of what a ray meets: the board with its white rim, else grey.
double brightness(const Point3& ray, const std::array<Point3, 3>& axes, const Point3& middle) {
  const double along = dot(ray, axes[2]);
  if (std::abs(along) < 1e-9) return 128.0;
  const double far = dot(middle, axes[2]) / along;
  if (far <= 0.0) return 128.0;
  const Point3 d{far * ray.x - middle.x, far * ray.y - middle.y, far * ray.z - middle.z};
  const double u = dot(d, axes[0]) + 0.5 * (kBoard.columns + 1);
  const double v = dot(d, axes[1]) + 0.5 * (kBoard.rows + 1);
  constexpr double kRim = 1.0;
  if (u < -kRim || v < -kRim || u > kBoard.columns + 1 + kRim || v > kBoard.rows + 1 + kRim)
    return 128.0;
  if (u < 0 || v < 0 || u > kBoard.columns + 1 || v > kBoard.rows + 1) return 230.0;
  return (static_cast<int>(u) + static_cast<int>(v)) % 2 == 0 ? 25.0 : 230.0;
}

constexpr int kSub = 3;  // rays of a pixel, along each side

/// Rays of all pixels; they are the same for all boards.
std::vector<std::array<float, 3>> raysOf(const CameraModel& model) {
  std::vector<std::array<float, 3>> rays;
  for (int v = 0; v < kSub * model.size().height; ++v)
    for (int u = 0; u < kSub * model.size().width; ++u) {
      const auto ray = model.unproject({(u + 0.5) / kSub - 0.5, (v + 0.5) / kSub - 0.5});
      const Point3 r = ray.value_or(Point3{});
      rays.push_back({static_cast<float>(r.x), static_cast<float>(r.y), static_cast<float>(r.z)});
    }
  return rays;
}

std::vector<std::uint8_t> draw(const std::vector<std::array<float, 3>>& rays, const ImageSize& size,
                               const Pose& pose) {
  const auto axes = axesOf(pose);
  std::vector<std::uint8_t> pixels;
  for (int v = 0; v < size.height; ++v)
    for (int u = 0; u < size.width; ++u) {
      double sum = 0.0;
      for (int i = 0; i < kSub * kSub; ++i) {
        const auto& r = rays[static_cast<std::size_t>((kSub * v + i / kSub) * kSub * size.width +
                                                      kSub * u + i % kSub)];
        sum += brightness({r[0], r[1], r[2]}, axes, {pose.x, pose.y, pose.z});
      }
      pixels.push_back(static_cast<std::uint8_t>(std::lround(sum / (kSub * kSub))));
    }
  return pixels;
}

std::vector<Pose> poses(double nearest, double spread) {
  std::vector<Pose> all;
  for (int i = 0; i < 20; ++i) {
    const double turn = 2.4 * i;
    const double far = spread * std::sqrt((i + 0.5) / 20.0);
    all.push_back({0.6 * std::sin(1.3 * turn), 0.6 * std::cos(1.7 * turn), 0.5 * std::sin(0.6 * i),
                   far * std::cos(turn), 0.75 * far * std::sin(turn), nearest + 0.5 * (i % 4)});
  }
  return all;
}

struct Case {
  const char* name;
  BoardModel model;
  double nearest, spread;  ///< of the boards [squares]
  std::vector<double> focal, distortion;
  double xi = 0.0;
  std::vector<double> polynomial;
};

Parameters cameraOf(const Case& c) {
  Parameters p(c.name);
  p.set("model", c.name);
  p.set("size_px", std::vector<double>{640, 480});
  p.set("centre_px", std::vector<double>{324.0, 236.5});
  if (!c.polynomial.empty()) {
    p.set("polynomial", c.polynomial);
    return p;
  }
  p.set("focal_px", c.focal);
  p.set("distortion", c.distortion);
  if (c.xi > 0.0) p.set("xi", c.xi);
  return p;
}

/// Pixels an angle of 1 rad would take at the axis, to the right.
double scaleOf(const CameraModel& model) {
  constexpr double kAngle = 0.01;  // [rad]
  return (model.project({kAngle, 0.0, 1.0})->u - model.project({-kAngle, 0.0, 1.0})->u) /
         (2.0 * kAngle);
}

class Boards : public testing::TestWithParam<Case> {};

TEST_P(Boards, GiveTheModelThatSawThem) {
  const Case& c = GetParam();
  const auto camera = readCamera(cameraOf(c));
  std::vector<std::vector<Pixel>> found;
  const auto rays = raysOf(*camera);
  for (const Pose& pose : poses(c.nearest, c.spread)) {
    const auto pixels = draw(rays, camera->size(), pose);
    if (const auto corners = findBoard({camera->size(), PixelFormat::kGrey, pixels.data()}, kBoard))
      found.push_back(*corners);
  }
  ASSERT_GE(found.size(), 10u);
  const BoardCalibration result = calibrateByBoards(c.model, camera->size(), kBoard, found);
  EXPECT_LT(result.error, 0.3) << "[px]";
  EXPECT_EQ(result.errors.size(), found.size());
  // Different numbers may mean the same lens (xi and focal length), so what they mean is compared:
  // how many pixels an angle at the axis takes, where the axis is, and directions where boards
  // were.
  EXPECT_NEAR(scaleOf(*result.model), scaleOf(*camera), 0.002 * scaleOf(*camera));
  const auto axis = result.model->project({0.0, 0.0, 1.0});
  ASSERT_TRUE(axis.has_value());
  EXPECT_NEAR(axis->u, 324.0, 0.002 * 324.0);
  EXPECT_NEAR(axis->v, 236.5, 0.002 * 236.5);
  double worst = 0.0;
  for (const auto& board : found)
    for (const Pixel& pixel : board) {
      const auto truth = camera->unproject(pixel);
      const auto ray = result.model->unproject(pixel);
      ASSERT_TRUE(truth && ray);
      worst = std::max(worst, std::acos(std::clamp(dot(*truth, *ray), -1.0, 1.0)));
    }
  EXPECT_LT(worst, 0.001) << "[rad]";
  const std::string toml = result.model->toml();
  EXPECT_NE(toml.find(std::string("model = \"") + c.name + "\""), toml.npos);
  RecordProperty("rms_px", std::to_string(result.error));
}

INSTANTIATE_TEST_SUITE_P(
    Of, Boards,
    testing::Values(
        Case{"perspective",
             BoardModel::kPerspective,
             13.0,
             3.0,
             {520.0, 515.0},
             {-0.25, 0.08, 0.001, -0.0005, 0.0},
             0.0,
             {}},
        Case{"fisheye",
             BoardModel::kFisheye,
             8.0,
             4.0,
             {300.0, 298.0},
             {-0.02, 0.006, -0.003, 0.0004},
             0.0,
             {}},
        Case{"unified",
             BoardModel::kUnified,
             8.0,
             4.0,
             {480.0, 478.0},
             {-0.1, 0.02, 0.0, 0.0},
             0.9,
             {}},
        Case{"ocam", BoardModel::kOcam, 4.5, 4.0, {}, {}, 0.0, {260.0, 0.0, -7e-4, 2e-7, -1e-9}}),
    [](const testing::TestParamInfo<Case>& one) { return one.param.name; });

/// Corners where a camera sees them, without drawing a picture and looking for them in it.
std::vector<std::vector<Pixel>> seenBy(const CameraModel& camera) {
  std::vector<std::vector<Pixel>> boards;
  for (const Pose& pose : poses(8.0, 4.0)) {
    const auto axes = axesOf(pose);
    std::vector<Pixel> corners;
    for (int row = 0; row < kBoard.rows; ++row)
      for (int column = 0; column < kBoard.columns; ++column) {
        const double x = column - 0.5 * (kBoard.columns - 1);
        const double y = row - 0.5 * (kBoard.rows - 1);
        const auto pixel = camera.project({pose.x + x * axes[0].x + y * axes[1].x,
                                           pose.y + x * axes[0].y + y * axes[1].y,
                                           pose.z + x * axes[0].z + y * axes[1].z});
        if (pixel && camera.contains(*pixel)) corners.push_back(*pixel);
      }
    if (corners.size() == static_cast<std::size_t>(kBoard.columns * kBoard.rows))
      boards.push_back(std::move(corners));
  }
  return boards;
}

// From a plain lens to one that sees more than a parabolic mirror does; the fit begins with such a
// mirror. Corners are rounded to single precision, which is 3e-5 px.
TEST(BoardCalibration, FindsUnifiedModelsWhateverXiIs) {
  for (const double xi : {0.0, 0.1, 0.5, 1.0, 1.6}) {
    SCOPED_TRACE(xi);
    Case c{"unified",
           BoardModel::kUnified,
           8.0,
           4.0,
           {250.0 * (1.0 + xi), 252.0 * (1.0 + xi)},
           {-0.05, 0.01, 0.0004, -0.0006},
           xi,
           {}};
    Parameters settings = cameraOf(c);
    settings.set("xi", xi);
    const auto camera = readCamera(settings);
    const auto boards = seenBy(*camera);
    ASSERT_GE(boards.size(), 10u);
    const BoardCalibration found =
        calibrateByBoards(BoardModel::kUnified, camera->size(), kBoard, boards);
    EXPECT_LT(found.error, 0.001) << "[px]";
    EXPECT_NEAR(scaleOf(*found.model), scaleOf(*camera), 1e-4 * scaleOf(*camera));
    const auto axis = found.model->project({0.0, 0.0, 1.0});
    ASSERT_TRUE(axis.has_value());
    EXPECT_NEAR(axis->u, 324.0, 0.01);
    EXPECT_NEAR(axis->v, 236.5, 0.01);
  }
}

TEST(BoardCalibration, SaysWhatIsMissing) {
  const std::vector<std::uint8_t> nothing(640 * 480, 128);
  EXPECT_FALSE(findBoard({{640, 480}, PixelFormat::kGrey, nothing.data()}, kBoard).has_value());
  const std::vector<std::vector<Pixel>> two(2, std::vector<Pixel>(54));
  EXPECT_THROW(calibrateByBoards(BoardModel::kPerspective, {640, 480}, kBoard, two),
               std::runtime_error);
  const std::vector<std::vector<Pixel>> same(5, std::vector<Pixel>(54, {7, 7}));
  for (const BoardModel model :
       {BoardModel::kPerspective, BoardModel::kFisheye, BoardModel::kUnified, BoardModel::kOcam})
    EXPECT_THROW(calibrateByBoards(model, {640, 480}, kBoard, same), std::runtime_error);
}

}  // namespace
}  // namespace ortung
