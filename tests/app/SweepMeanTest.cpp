#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "SweepMean.hpp"

namespace ortung::app {
namespace {

SweepTable::Cell cellOf(const std::vector<double>& values) {
  SweepMean mean;
  for (const double value : values) mean.add(value);
  return mean.cell();
}

// Of 1, 2, 3, 6 the variance is 14 / 3, and that of the mean a quarter of it.
TEST(SweepMean, HasTheStandardErrorOfTheMean) {
  const SweepTable::Cell cell = cellOf({1.0, 2.0, 3.0, 6.0, std::nan("")});
  EXPECT_EQ(cell.count, 4u);
  EXPECT_DOUBLE_EQ(cell.mean, 3.0);
  EXPECT_DOUBLE_EQ(cell.error, std::sqrt(14.0 / 3.0 / 4.0));
}

TEST(SweepMean, ErrorsOfRoundingAloneAreNone) {
  const double next = std::nextafter(1999.7, 2e3);
  EXPECT_EQ(cellOf({1999.7, next, 1999.7, next}).error, 0.0);
  EXPECT_EQ(cellOf({-1999.7, -next}).error, 0.0);
  EXPECT_EQ(cellOf({0.0, 0.0}).error, 0.0);
  EXPECT_GT(cellOf({1.0, 1.0 + 1e-9}).error, 0.0) << "small, but an error";
  EXPECT_GT(cellOf({0.0, 1e-100}).error, 0.0);
}

TEST(SweepMean, OneValueHasNoErrorAndNoneNoMean) {
  EXPECT_TRUE(std::isnan(cellOf({2.0}).error));
  EXPECT_EQ(cellOf({2.0}).mean, 2.0);
  EXPECT_TRUE(std::isnan(cellOf({}).mean));
}

}  // namespace
}  // namespace ortung::app
