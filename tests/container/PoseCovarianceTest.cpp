#include <gtest/gtest.h>

#include "ortung/base/PoseCovariance.hpp"

namespace ortung {
namespace {

TEST(PoseCovariance, OfIndependentErrorsHasTheirVariancesAndNothingElse) {
  EXPECT_EQ(independent(2.0, 3.0, 5.0), (PoseCovariance{2, 0, 0, 0, 3, 0, 0, 0, 5}));
  EXPECT_EQ(independent(0.0, 0.0, 0.0), PoseCovariance{});
  EXPECT_EQ(positionVariance(independent(2.0, 3.0, 5.0)), 5.0);
  EXPECT_EQ(headingVariance(independent(2.0, 3.0, 5.0)), 5.0);
}

TEST(PoseCovariance, GrowsByErrorsThatAreIndependentOfIt) {
  PoseCovariance covariance{2, 0.5, 0.25, 0.5, 3, 0.125, 0.25, 0.125, 5};
  addVariances(covariance, 10.0, 100.0);
  EXPECT_EQ(covariance, (PoseCovariance{12, 0.5, 0.25, 0.5, 13, 0.125, 0.25, 0.125, 105}));
}

}  // namespace
}  // namespace ortung
