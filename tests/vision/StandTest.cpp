/// Cameras whose tilt sensors tell up to an offset, on fields that may not be to scale.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "DrawnPoints.hpp"
#include "MslLines.hpp"
#include "Paths.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/calibration/ImageFile.hpp"
#include "ortung/calibration/StandCalibration.hpp"
#include "ortung/vision/FloorSight.hpp"

namespace ortung {
namespace {

constexpr MslSizes kSpl{.length = 9.0,
                        .width = 6.0,
                        .penaltyWidth = 4.0,
                        .penaltyDepth = 1.65,
                        .goalWidth = 2.2,
                        .goalDepth = 0.6,
                        .circle = 1.5,
                        .mark = 1.3,
                        .line = 0.05};

std::vector<FieldLine> larger(std::vector<FieldLine> lines, double scale) {
  for (FieldLine& line : lines)
    for (double* length :
         {&line.x0, &line.y0, &line.x1, &line.y1, &line.x, &line.y, &line.radiusX, &line.radiusY})
      *length *= scale;
  return lines;
}

CameraView headCamera(double tilt) {
  Parameters p("camera");
  p.set("model", "perspective");
  p.set("size_px", std::vector<double>{640, 480});
  p.set("focal_px", std::vector<double>{570, 570});
  return {readCamera(p), {.z = 0.45, .tilt = tilt}};
}

TEST(Stand, FindsHeightOffsetAndTheScaleOfTheField) {
  constexpr double kOffset = 0.06, kScale = 1.04;
  const std::vector<FieldLine> painted = larger(mslLines(kSpl), kScale);
  const Pose2 poses[] = {
      {-2.0, 0.5, 0.1}, {-1.0, -1.2, 1.0}, {1.5, 0.8, 2.9}, {-3.0, 1.0, -0.4}, {0.5, 2.0, -1.9}};
  Random random(4);
  std::vector<Stand> stands;
  for (const Pose2& pose : poses) {
    const double tilt = random.uniform(-0.1, 0.2);
    Stand stand;
    stand.lines = PerfectDetector{}(FieldLines(painted), headCamera(tilt + kOffset), pose, random);
    stand.tilt = tilt;
    const double half = stands.size() % 2 == 0 ? 1.0 : -1.0;  // both halves look the same
    stand.place = LinePlace{half * pose.x, half * pose.y};
    stands.push_back(stand);
  }
  const LinePoseSearch search{FieldLines(mslLines(kSpl))};
  StandGuess guess{.height = 0.42, .focal = 600.0, .isPlain = true};
  const auto found = calibrateStand({640, 480}, stands, search, guess);
  ASSERT_TRUE(found);
  ASSERT_TRUE(found->scale);
  EXPECT_NEAR(found->scale->scale, kScale, 0.01);
  EXPECT_NEAR(found->scale->scale, kScale, 4.0 * found->scale->sigma + 1e-3);
  EXPECT_NEAR(found->view.place().tilt, kOffset, 0.005);
  EXPECT_NEAR(found->view.place().z, 0.45, 0.01);
  for (const StandFit& fit : found->stands) EXPECT_LT(*fit.off, 0.04);

  for (Stand& stand : stands) stand.place.reset();
  const auto blind = calibrateStand({640, 480}, stands, search, guess);
  EXPECT_FALSE(blind->scale);
  EXPECT_NEAR(blind->view.place().z, 0.45 / kScale, 0.01) << "lengths are those of the field";
}

TEST(Stand, ScaleOfPlacesIsThatOfASimilarity) {
  const std::vector<LinePlace> found = {{1.0, 0.5}, {-2.0, 1.0}, {0.5, -1.5}, {3.0, 0.2}};
  std::vector<LinePlace> known;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const double half = i % 2 == 0 ? 1.0 : -1.0;
    const double c = std::cos(0.02), s = std::sin(0.02);
    known.push_back({half * (1.1 * (c * found[i].x - s * found[i].y) + 0.03),
                     half * (1.1 * (s * found[i].x + c * found[i].y) - 0.02)});
  }
  const auto scale = scaleOf(found, known);
  ASSERT_TRUE(scale);
  EXPECT_GT(scale->scale, 1.09);
  EXPECT_LT(scale->scale, 1.11);
  EXPECT_FALSE(scaleOf({found.data(), 2}, {known.data(), 2}));
  const std::vector<LinePlace> same(4, LinePlace{1.0, 1.0});
  EXPECT_FALSE(scaleOf(same, same));
  EXPECT_FALSE(scaleOf(found, {known.data(), 3}));
}

TEST(Stand, WithoutLinesIsNothing) {
  const LinePoseSearch search{FieldLines(mslLines(kSpl))};
  EXPECT_FALSE(calibrateStand({640, 480}, {}, search, {}));
  const std::vector<Stand> empty(3);
  EXPECT_FALSE(calibrateStand({640, 480}, empty, search, {}));
}

}  // namespace
}  // namespace ortung
