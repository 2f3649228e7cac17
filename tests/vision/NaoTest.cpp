/// Pictures of a Nao (../shared/data/nao_optitrack) beside its place by a motion capture system.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "MslLines.hpp"
#include "Paths.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/calibration/ImageFile.hpp"
#include "ortung/calibration/LineCalibration.hpp"
#include "ortung/vision/FloorSight.hpp"

namespace ortung {
namespace {

/// One stand: what the robot's joints and inertial sensor said, and where OptiTrack saw its head.
struct Stand {
  double headPitch, bodyPitch;  ///< [rad]
  double x, z;                  ///< of the head's markers, in OptiTrack's floor plane [m]
};
constexpr Stand kStands[] = {{0.07819, -0.09242, 1.626, -1.004},
                             {0.00149, -0.09952, 1.849, 0.330},
                             {-0.00311, -0.14247, 0.568, 1.091},
                             {0.06132, -0.07095, -2.118, -0.026},
                             {-0.13043, 0.00805, -1.007, -0.519}};
/// The camera of a Nao is so far in front of the head's axis (its maker's figure) [m].
constexpr double kCameraAhead = 0.059;
/// Between what the sensors say and the camera's axis, the same in all stands [rad].
constexpr double kTiltOffset = 0.0728;

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

TEST(Nao, ItsPlaceBySinglePicturesIsWithinTenCentimetresOfMotionCapture) {
  const std::filesystem::path folder = std::filesystem::path(ORTUNG_SHARED_DATA) / "nao_optitrack";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is absent";
  const LinePoseSearch search{FieldLines(labLines())};
  for (int i = 0; i < 5; ++i) {
    const Stand& stand = kStands[i];
    const Picture picture =
        readPicture(folder / "red1" / ("punt" + std::to_string(i + 1)) / "imagetop.jpg");
    const ImageView view = picture.view();
    const ColourTable colours(findColours({&view, 1}));
    LineFinder finder({});
    const auto points = finder.find(view, colours);
    const LinePicture lines{{points.begin(), points.end()}, floorTopOf(view, colours)};
    // Focal length from the maker's field of view; the height is that of the head's markers less
    // how far they are above the camera.
    const auto found = calibrateByLines(picture.size, {&lines, 1}, search,
                                        {.height = 0.41,
                                         .heightShare = 0.02,
                                         .tilt = stand.headPitch + stand.bodyPitch + kTiltOffset,
                                         .tiltSigma = 0.005,
                                         .focalShare = 0.03,
                                         .distortion = LineCalibrationGuess::kPlainLens,
                                         .focals = {598.0 / 640.0}});
    ASSERT_TRUE(found);
    const Pose2& camera = found->pictures[0].pose;
    const Pose2 head = camera * Pose2{-kCameraAhead, 0.0, 0.0};
    // OptiTrack's x points against ours. Both halves of the field look the same.
    const double off = std::min(std::hypot(head.x + stand.x, head.y - stand.z),
                                std::hypot(head.x - stand.x, head.y + stand.z));
    std::printf("stand %d: (%.3f, %.3f, %.0f deg), off by %.3f m\n", i + 1, head.x, head.y,
                degrees(head.theta), off);
    EXPECT_LT(off, 0.10);
  }
}

}  // namespace
}  // namespace ortung
