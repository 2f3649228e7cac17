/// What of a field's lines a picture shows, by a camera that looks straight down.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "ortung/base/Parameters.hpp"
#include "ortung/calibration/ImageFile.hpp"
#include "ortung/vision/LinesInSight.hpp"

namespace ortung {
namespace {

constexpr std::array<std::uint8_t, 3> kGreen{40, 140, 60};
constexpr std::array<std::uint8_t, 3> kWhite{230, 230, 230};
constexpr std::array<std::uint8_t, 3> kBlack{15, 15, 15};

/// 2 m above the floor, 100 px a radian's tangent: a pixel is 2 cm.
CameraView fromAbove() {
  Parameters p("camera");
  p.set("size_px", std::vector<double>{401, 401});
  p.set("focal_px", std::vector<double>{100, 100});
  p.set("centre_px", std::vector<double>{200, 200});
  return {readCamera(p), {.z = 2.0, .tilt = std::numbers::pi / 2}};
}

/// A line of 4 m across the picture, and a spot of 0.3 m beside it.
FieldLines lineAndSpot() {
  FieldLine line;
  line.x0 = -2.0, line.x1 = 2.0, line.width = 0.1;
  FieldLine spot;
  spot.shape = FieldLine::Shape::kArc;
  spot.x = 1.0, spot.y = 1.0, spot.radiusX = spot.radiusY = 0.15;
  spot.to = 2.0 * std::numbers::pi, spot.width = 0.3;
  return FieldLines(std::vector<FieldLine>{line, spot});
}

struct Painted {
  Picture picture{{401, 401}, {}};
  std::vector<LinePoint> points;
};

/// The half of the line at positive x is found, a quarter is hidden by something black, and the
/// rest is bare floor. In the image ahead is up.
Painted painted(bool withSpot) {
  Painted painted;
  for (int i = 0; i < 401 * 401; ++i)
    painted.picture.pixels.insert(painted.picture.pixels.end(), kGreen.begin(), kGreen.end());
  const CameraView view = fromAbove();
  for (double x = 0.05; x < 2.0; x += 0.1)
    painted.points.push_back({*view.pixelOf({x, 0.0, 0.0}), 5.0, true});
  const auto paint = [&](double x0, double x1, double y0, double y1, const auto& colour) {
    for (int v = 0; v < 401; ++v)
      for (int u = 0; u < 401; ++u) {
        const auto at = view.floorAt({double(u), double(v)});
        if (at->x > x0 && at->x < x1 && at->y > y0 && at->y < y1)
          std::copy(colour.begin(), colour.end(),
                    painted.picture.pixels.begin() + 3 * (v * 401 + u));
      }
  };
  paint(-1.0, -0.04, -0.3, 0.3, kBlack);
  if (withSpot) paint(0.85, 1.15, 0.85, 1.15, kWhite);
  return painted;
}

TEST(LinesInSight, TellsWhatIsFoundMissingAndHidden) {
  const Painted seen = painted(true);
  const FloorMask mask(seen.picture.view(), ColourTable({}));
  const LinesInSight all =
      linesInSight(lineAndSpot(), fromAbove(), Pose2{}, seen.points, mask, 5.0);
  EXPECT_NEAR(all.found, 2.0, 0.31);  // points reach 14 px, 0.28 m, farther
  EXPECT_NEAR(all.hidden, 0.7, 0.21);
  EXPECT_NEAR(all.missing, 1.0, 0.11);
  EXPECT_NEAR(all.missingShare(), all.missing / (all.missing + all.found), 1e-12);
  EXPECT_EQ(all.marksFound, 1);
  EXPECT_EQ(all.marksMissing, 0);
  const Painted bare = painted(false);
  const FloorMask bareMask(bare.picture.view(), ColourTable({}));
  EXPECT_EQ(linesInSight(lineAndSpot(), fromAbove(), {}, bare.points, bareMask, 5.0).marksMissing,
            1);
  // Nothing beyond the range, and without a picture nothing is hidden.
  const LinesInSight near = linesInSight(lineAndSpot(), fromAbove(), {}, seen.points, {}, 0.5);
  EXPECT_NEAR(near.found + near.missing, 1.0, 0.21);
  EXPECT_EQ(near.hidden, 0.0);
}

TEST(FloorMask, IsFloorWhereMostPixelsAre) {
  const Painted seen = painted(true);
  const FloorMask mask(seen.picture.view(), ColourTable({}));
  EXPECT_TRUE(mask.isKnown());
  EXPECT_TRUE(mask.isFloor({20.0, 20.0}));
  EXPECT_FALSE(mask.isFloor(*fromAbove().pixelOf({1.0, 1.0, 0.0})));
  for (const Pixel outside :
       {Pixel{-1.0, 5.0}, Pixel{5.0, 401.0}, Pixel{1e30, 5.0}, Pixel{std::nan(""), 5.0}})
    EXPECT_FALSE(mask.isFloor(outside));
  EXPECT_FALSE(FloorMask().isKnown());
  EXPECT_FALSE(FloorMask().isFloor({0.0, 0.0}));
}

}  // namespace
}  // namespace ortung
