#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "ortung/base/Random.hpp"
#include "ortung/study/Calibration.hpp"

namespace ortung {
namespace {

TEST(Calibration, ClaimsThatComeTrueAsOftenAsTheySayAreCalibrated) {
  Random random(3);
  std::vector<Claim> claims;
  for (int i = 0; i < 200000; ++i) {
    const double p = random.uniform();
    claims.push_back({static_cast<float>(p), random.uniform() < p});
  }
  const Calibration found = calibrationOf(claims);
  EXPECT_LT(found.error, 0.01);
  for (std::size_t i = 0; i < found.bins.size(); ++i) {
    EXPECT_NEAR(found.bins[i].claimed, 0.1 * static_cast<double>(i) + 0.05, 0.002);
    EXPECT_NEAR(found.bins[i].share, found.bins[i].claimed, 0.015);
    EXPECT_NEAR(static_cast<double>(found.bins[i].count), 20000.0, 600.0);
  }
  // P(p1 > p0) with the densities 2p of those that came true and 2(1 - p) of the others: 5/6.
  EXPECT_NEAR(found.area, 5.0 / 6, 0.004);
}

// By hand: of {0.9, 0.8, 0.4} true and {0.8, 0.2} false: 0.9 beats two, 0.8 one and a half, 0.4
// one.
TEST(Calibration, TiesCountHalf) {
  const Calibration found =
      calibrationOf({{0.9F, true}, {0.8F, true}, {0.4F, true}, {0.8F, false}, {0.2F, false}});
  EXPECT_NEAR(found.area, 4.5 / 6, 1e-12);
  EXPECT_EQ(found.bins[8].count, 2u);
  EXPECT_NEAR(found.bins[8].share, 0.5, 1e-12);
  // |0.9-1| + 2 |0.8-0.5| + |0.4-1| + |0.2-0|, of five.
  EXPECT_NEAR(found.error, (0.1 + 0.6 + 0.6 + 0.2) / 5, 1e-6);
}

TEST(Calibration, OneIsInTheLastBinAndNothingIsNotKnown) {
  const Calibration sure = calibrationOf({{1.0F, true}, {0.0F, true}});
  EXPECT_EQ(sure.bins[9].count, 1u);
  EXPECT_EQ(sure.bins[0].count, 1u);
  EXPECT_TRUE(std::isnan(sure.area)) << "nothing came out wrong";
  EXPECT_TRUE(std::isnan(sure.bins[5].share));
  EXPECT_TRUE(std::isnan(calibrationOf({}).error));
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(std::isnan(calibrationOf({{nan, true}, {1.5F, false}, {-0.1F, true}}).error));
}

}  // namespace
}  // namespace ortung
