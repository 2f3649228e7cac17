/// Pictures of a Nao (../shared/data/nao_optitrack) beside its place by a motion capture system.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "MslLines.hpp"
#include "Paths.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/calibration/ImageFile.hpp"
#include "ortung/calibration/StandCalibration.hpp"
#include "ortung/vision/FloorSight.hpp"

namespace ortung {
namespace {

/// One stand: what the robot's joints and inertial sensor said, and where OptiTrack saw its head.
struct Measured {
  double headPitch, bodyPitch;  ///< [rad]
  double x, z;                  ///< of the head's markers, in OptiTrack's floor plane [m]
};
constexpr Measured kStands[] = {{0.07819, -0.09242, 1.626, -1.004},
                                {0.00149, -0.09952, 1.849, 0.330},
                                {-0.00311, -0.14247, 0.568, 1.091},
                                {0.06132, -0.07095, -2.118, -0.026},
                                {-0.13043, 0.00805, -1.007, -0.519}};
/// The camera of a Nao is so far in front of the head's axis (its maker's figure) [m].
constexpr double kCameraAhead = 0.059;

/// The lab's field is smaller than the rules': circle and middle line are theirs; where touch line
/// and penalty area are, the pictures of the first stand say.
std::vector<FieldLine> labLines() {
  std::vector<FieldLine> lines;
  for (const FieldLine& line : mslLines({.length = 9.0, .width = 6.0, .circle = 1.5, .line = 0.05}))
    if ((line.shape == FieldLine::Shape::kArc && line.x == 0.0) ||
        (line.x0 == 0.0 && line.x1 == 0.0))
      lines.push_back(line);
  const auto straight = [&](double x0, double y0, double x1, double y1) {
    FieldLine line;
    line.x0 = x0, line.y0 = y0, line.x1 = x1, line.y1 = y1, line.width = 0.05;
    lines.push_back(line);
  };
  for (const double side : {-1.0, 1.0}) {
    straight(-4.2, side * 2.76, 4.2, side * 2.76);
    straight(side * 4.2, -2.76, side * 4.2, 2.76);
    straight(side * 2.76, -2.0, side * 2.76, 2.0);
  }
  return lines;
}

/// The lines of a picture, as the command looks for them.
LinePicture linesOf(const Picture& picture) {
  const ImageView view = picture.view();
  const ColourTable colours(findColours({&view, 1}));
  LineFinder finder({});
  const auto points = finder.find(view, colours);
  return {{points.begin(), points.end()}, floorTopOf(view, colours), {view, colours}};
}

TEST(Nao, ItsPlacesAreWithinSevenCentimetresOfMotionCapture) {
  const std::filesystem::path folder = std::filesystem::path(ORTUNG_SHARED_DATA) / "nao_optitrack";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is absent";
  const LinePoseSearch search{FieldLines(labLines())};
  std::vector<Stand> stands;
  ImageSize size;
  for (int i = 0; i < 5; ++i) {
    const Measured& is = kStands[i];
    const Picture picture =
        readPicture(folder / "red1" / ("punt" + std::to_string(i + 1)) / "imagetop.jpg");
    size = picture.size;
    // OptiTrack's x points against ours.
    stands.push_back({linesOf(picture), is.headPitch + is.bodyPitch, LinePlace{-is.x, is.z}});
  }
  // Focal length from the maker's field of view; the height is that of the head's markers less how
  // far they are above the camera.
  const StandGuess guess{.height = 0.41,
                         .heightShare = 0.05,
                         .focalShare = 0.05,
                         .focal = 598.0,
                         .isPlain = true,
                         .ahead = kCameraAhead};
  const auto placed = calibrateStand(size, stands, search, guess);
  ASSERT_TRUE(placed && placed->scale);
  std::printf("%sheight %.3f m, offset %.2f degrees, scale %.3f, sigma %.3f\n",
              placed->view.model().toml().c_str(), placed->view.place().z,
              degrees(placed->view.place().tilt), placed->scale->scale, placed->scale->sigma);
  EXPECT_NEAR(placed->scale->scale, 1.0, 3.0 * placed->scale->sigma);
  EXPECT_LT(placed->scale->rootMeanSquare, 0.05);
  for (Stand& stand : stands) stand.place.reset();
  const auto found = calibrateStand(size, stands, search, guess);
  ASSERT_TRUE(found);
  for (std::size_t i = 0; i < 5; ++i) {
    const StandFit& fit = found->stands[i];
    const Measured& is = kStands[i];
    const double off = std::min(std::hypot(fit.robot.x + is.x, fit.robot.y - is.z),
                                std::hypot(fit.robot.x - is.x, fit.robot.y + is.z));
    std::printf("stand %zu: (%.3f, %.3f, %.0f deg), off by %.3f m\n", i + 1, fit.robot.x,
                fit.robot.y, degrees(fit.camera.theta), off);
    EXPECT_LT(off, 0.07);
  }
}

}  // namespace
}  // namespace ortung
