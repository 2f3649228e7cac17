/// Beams of a scanner's first scan, and later scans that are fitted to them.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "ScanShape.hpp"

namespace ortung::ros2 {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kEndless = std::numeric_limits<float>::infinity();

LaserScan scanOf(float first, float step, std::vector<float> ranges) {
  LaserScan scan;
  scan.header.frame = "laser";
  scan.angleMin = first;
  scan.angleIncrement = step;
  scan.rangeMax = 8.0F;
  scan.ranges = std::move(ranges);
  return scan;
}

/// Ranges with -1 for those that are not valid.
std::vector<float> plain(std::vector<float> ranges) {
  for (float& range : ranges)
    if (std::isnan(range)) range = -1.0F;
  return ranges;
}

std::string complaint(const LaserScan& scan) {
  try {
    const ScanShape shape(scan);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(ScanShape, RangesThatAreNotPositiveAreNotValid) {
  const LaserScan scan = scanOf(-0.5F, 0.25F, {1.0F, 0.0F, -2.0F, kNan, kEndless, -kEndless});
  const ScanShape shape(scan);
  EXPECT_EQ(plain(shape.fit(scan)),
            (std::vector<float>{1.0F, -1.0F, -1.0F, -1.0F, kEndless, -1.0F}));
  EXPECT_TRUE(shape.isSame(scan));
  EXPECT_EQ(shape.frame(), "laser");
  EXPECT_EQ(shape.maxRange(), 8.0);
  EXPECT_FALSE(shape.isClockwise());
}

// Beams at -0.5, -0.25, ..., 0.5. A scan with beams at -0.34, -0.14, 0.06, 0.26, 0.46: the nearest
// ones are taken, and none where none is near.
TEST(ScanShape, TheNearestBeamsOfAnotherScanAreTaken) {
  const ScanShape shape(scanOf(-0.5F, 0.25F, {1, 1, 1, 1, 1}));
  EXPECT_EQ(plain(shape.fit(scanOf(-0.34F, 0.2F, {1, 2, 3, 4, 5}))),
            (std::vector<float>{-1.0F, 1.0F, 3.0F, 4.0F, 5.0F}));
  EXPECT_EQ(plain(shape.fit(scanOf(-0.5F, 0.125F, {1, 2, 3, 4, 5}))),
            (std::vector<float>{1.0F, 3.0F, 5.0F, -1.0F, -1.0F}));
  EXPECT_EQ(plain(shape.fit(scanOf(0.5F, 0.25F, {7}))),
            (std::vector<float>{-1.0F, -1.0F, -1.0F, -1.0F, 7.0F}));
  EXPECT_FALSE(shape.isSame(scanOf(-0.5F, 0.25F, {1, 1, 1, 1})));
  EXPECT_FALSE(shape.isSame(scanOf(-0.4F, 0.25F, {1, 1, 1, 1, 1})));
  EXPECT_FALSE(shape.isSame(scanOf(-0.5F, 0.2F, {1, 1, 1, 1, 1})));
}

TEST(ScanShape, ScansOfOtherAnglesOrDirectionsHaveNothingInCommon) {
  const ScanShape shape(scanOf(-0.5F, 0.25F, {1, 1, 1, 1, 1}));
  EXPECT_TRUE(shape.fit(scanOf(0.75F, 0.25F, {1, 2})).empty());
  EXPECT_TRUE(shape.fit(scanOf(0.5F, -0.25F, {1, 2, 3, 4, 5})).empty());
  EXPECT_TRUE(shape.fit(scanOf(kNan, 0.25F, {1, 2, 3, 4, 5})).empty());
  EXPECT_TRUE(shape.fit(scanOf(-0.5F, 0.0F, {1, 2, 3, 4, 5})).empty());
  EXPECT_TRUE(shape.fit(scanOf(-0.5F, 0.25F, {})).empty());
}

// A scanner that sees all around repeats its first beam: 4 steps of a quarter, 5 beams.
TEST(ScanShape, ABeamTwiceIsOneBeam) {
  const LaserScan scan = scanOf(-3.1415927F, 1.5707964F, {1, 2, 3, 4, 1});
  const ScanShape shape(scan);
  EXPECT_EQ(shape.fit(scan), (std::vector<float>{1, 2, 3, 4}));
  const Scanner scanner = shape.scanner(false);
  EXPECT_EQ(scanner.beams, 4);
  EXPECT_LE(scanner.angleStep * 4, 2 * std::numbers::pi);
}

// From 0.5 rad clockwise to -0.25 rad; upside down, these are -0.5 to 0.25 rad as seen from above.
TEST(ScanShape, ScannersBeginWithTheirRightmostBeam) {
  const ScanShape shape(scanOf(0.5F, -0.25F, {1, 2, 3, 4}));
  EXPECT_TRUE(shape.isClockwise());
  EXPECT_NEAR(shape.scanner(false).firstAngle, -0.25, 1e-9);
  EXPECT_NEAR(shape.scanner(false).angleStep, 0.25, 1e-9);
  EXPECT_NEAR(shape.scanner(true).firstAngle, -0.5, 1e-9);
  const ScanShape left(scanOf(0.5F, 0.25F, {1, 2, 3}));
  EXPECT_NEAR(left.scanner(false).firstAngle, 0.5, 1e-9);
  EXPECT_NEAR(left.scanner(true).firstAngle, -1.0, 1e-9);
  // Angles that begin beyond a turn are the same ones within it.
  const ScanShape far(scanOf(7.0F, 0.25F, {1, 2}));
  EXPECT_NEAR(far.scanner(false).firstAngle, 7.0 - 2 * std::numbers::pi, 1e-6);
}

TEST(ScanShape, TheGreatestRangeIsWithinReason) {
  for (const auto& [told, known] : {std::pair{8.5F, 8.5},
                                    {1000.0F, 1000.0},
                                    {1000.5F, 0.0},
                                    {0.0F, 0.0},
                                    {-1.0F, 0.0},
                                    {kEndless, 0.0},
                                    {kNan, 0.0}}) {
    LaserScan scan = scanOf(0, 0.1F, {1});
    scan.rangeMax = told;
    EXPECT_EQ(ScanShape(scan).maxRange(), known) << told;
  }
}

TEST(ScanShape, RefusesBeamsThatNoScannerHas) {
  EXPECT_EQ(complaint(scanOf(0, 1e-4F, std::vector<float>(8192, 1.0F))), "");
  EXPECT_EQ(complaint(scanOf(0, 1e-4F, std::vector<float>(8193, 1.0F))),
            "found 8193 beams, expected at most 8192");
  EXPECT_EQ(complaint(scanOf(12.5F, 0.1F, {1})), "");
  for (const LaserScan& scan :
       {scanOf(0, 0.1F, {}), scanOf(0, 0, {1}), scanOf(kNan, 0.1F, {1}), scanOf(0, kEndless, {1}),
        scanOf(12.6F, 0.1F, {1}), scanOf(-12.6F, 0.1F, {1})})
    EXPECT_NE(complaint(scan).find("expected at least one, within a turn"), std::string::npos)
        << scan.angleMin;
}

}  // namespace
}  // namespace ortung::ros2
