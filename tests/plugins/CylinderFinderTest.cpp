// Cylinders in scans of circles and a wall behind them, whose ranges are known in closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "ortung/base/Random.hpp"
#include "sensors/lrf_cylinders/CylinderFinder.hpp"

namespace ortung {
namespace {

constexpr double kStep = std::numbers::pi / 360.0;  // [rad]
constexpr double kFirst = -std::numbers::pi / 2;
constexpr int kBeams = 361;

struct Circle {
  double range, bearing, radius;
};

/// The nearest of circles and a round wall 4 m away.
std::vector<float> scanOf(const std::vector<Circle>& circles, Random* noise = nullptr) {
  std::vector<float> ranges;
  for (int i = 0; i < kBeams; ++i) {
    const double angle = kFirst + i * kStep;
    double range = 4.0;
    for (const Circle& c : circles) {
      const double aside = c.range * std::sin(angle - c.bearing);
      if (std::cos(angle - c.bearing) > 0.0 && std::abs(aside) < c.radius)
        range = std::min(range, c.range * std::cos(angle - c.bearing) -
                                    std::sqrt(c.radius * c.radius - aside * aside));
    }
    if (noise != nullptr) range += 0.005 * noise->gaussian();
    ranges.push_back(static_cast<float>(range));
  }
  return ranges;
}

const CylinderLooks kLooks{.radius = 0.1, .breakDistance = 0.15, .tolerance = 0.02};

TEST(CylinderFinder, FindsAxesToMillimetres) {
  const std::vector<Circle> circles = {{1.0, -1.1, 0.1}, {2.0, 0.0, 0.1}, {3.0, 0.7, 0.1}};
  const std::vector<float> scan = scanOf(circles);
  const auto found = findCylinders(scan, kFirst, kStep, kLooks);
  ASSERT_EQ(found.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(found[i].range, circles[i].range, 0.001);
    EXPECT_NEAR(found[i].bearing, circles[i].bearing, 0.0005);
  }
  Random noise(1);
  for (const Cylinder& one : findCylinders(scanOf(circles, &noise), kFirst, kStep, kLooks))
    EXPECT_NEAR(one.range, circles[one.bearing < -0.5 ? 0 : one.bearing < 0.4 ? 1 : 2].range, 0.01);
}

TEST(CylinderFinder, LeavesOutWhatIsWiderNarrowerOrHalfHidden) {
  EXPECT_TRUE(findCylinders(scanOf({{2.0, 0.0, 0.3}}), kFirst, kStep, kLooks).empty());
  EXPECT_TRUE(findCylinders(scanOf({{2.0, 0.0, 0.03}}), kFirst, kStep, kLooks).empty());
  // Something nearer ends where it begins.
  EXPECT_TRUE(
      findCylinders(scanOf({{2.0, 0.0, 0.1}, {1.0, 0.35, 0.33}}), kFirst, kStep, kLooks).empty());
  // At the rim of the field of view nobody knows what is beside it.
  EXPECT_TRUE(findCylinders(scanOf({{2.0, kFirst, 0.1}}), kFirst, kStep, kLooks).empty());
}

TEST(CylinderFinder, TakesWhatIsNotValidForNothingAndWhatIsBeyondReachForFar) {
  std::vector<float> scan = scanOf({{2.0, 0.0, 0.1}});
  for (float& range : scan)
    if (range > 3.9F) range = std::numeric_limits<float>::infinity();
  EXPECT_EQ(findCylinders(scan, kFirst, kStep, kLooks).size(), 1u);
  for (float& range : scan)
    if (range > 3.9F) range = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(findCylinders(scan, kFirst, kStep, kLooks).empty());
  EXPECT_TRUE(findCylinders({}, kFirst, kStep, kLooks).empty());
  EXPECT_TRUE(findCylinders(std::vector<float>(3, 0.0F), kFirst, kStep, kLooks).empty());
}

}  // namespace
}  // namespace ortung
