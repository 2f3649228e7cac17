// How far an estimate can be relied on: closed forms, and what each sign does to it.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "Confidence.hpp"

namespace ortung {
namespace {

PoseCovariance covarianceOf(double xx, double xy, double yy) {
  return {xx, xy, 0, xy, yy, 0, 0, 0, 0.01};
}

TEST(ProbabilityWithin, OfARoundGaussianIsTheClosedForm) {
  for (const double sigma : {0.01, 0.1, 0.3, 0.5, 1.0, 5.0, 100.0}) {
    const double exact = 1.0 - std::exp(-0.25 / (2.0 * sigma * sigma));
    EXPECT_NEAR(probabilityWithin(covarianceOf(sigma * sigma, 0, sigma * sigma), 0.5), exact, 2e-3)
        << sigma;
  }
}

TEST(ProbabilityWithin, OfALineIsTheErrorFunctionWhateverItsDirection) {
  for (const double angle : {0.0, 0.4, 0.25 * std::numbers::pi, 1.3, 0.5 * std::numbers::pi}) {
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    const double exact = std::erf(0.5 / (0.6 * std::numbers::sqrt2));
    EXPECT_NEAR(probabilityWithin(covarianceOf(0.36 * c * c, 0.36 * c * s, 0.36 * s * s), 0.5),
                exact, 1e-2)
        << angle;
  }
}

TEST(ProbabilityWithin, OfNoSpreadIsOne) { EXPECT_NEAR(probabilityWithin({}, 0.5), 1.0, 1e-6); }

PoseEstimate narrow() {
  PoseEstimate estimate;
  estimate.covariance = covarianceOf(0.0025, 0, 0.0025);
  estimate.share = 1.0;
  return estimate;
}

PoseEstimate judged(const Signs& signs, PoseEstimate estimate = narrow()) {
  judge(signs, estimate);
  return estimate;
}

TEST(Judge, ReliesOnANarrowBeliefThatReadingsFit) {
  const PoseEstimate estimate = judged({});
  EXPECT_EQ(estimate.status, TrackStatus::kTracking);
  EXPECT_EQ(estimate.reason, TrackReason::kFits);
  EXPECT_GT(estimate.quality, 0.98);
  EXPECT_EQ(std::string(nameOf(estimate.status)), "tracking");
}

TEST(Judge, SaysWhatSpeaksAgainstIt) {
  EXPECT_EQ(judged({.isFrozen = true}).reason, TrackReason::kFrozen);
  EXPECT_EQ(judged({.isConfirmed = false}).reason, TrackReason::kUnconfirmed);
  EXPECT_EQ(judged({.silence = 3.1}).reason, TrackReason::kNoReading);
  EXPECT_EQ(judged({.silence = std::nullopt}).reason, TrackReason::kNoReading);
  EXPECT_EQ(judged({.silence = 2.9}).reason, TrackReason::kFits);
  EXPECT_EQ(judged({.lead = 4.0}).reason, TrackReason::kRival);
  EXPECT_EQ(judged({.lead = 3.9}).reason, TrackReason::kFits);
  EXPECT_EQ(judged({.unusual = 1}).reason, TrackReason::kPoorFit);
  EXPECT_EQ(judged({.trustsOdometry = false}).reason, TrackReason::kOdometry);
  EXPECT_EQ(judged({.isLate = true, .mayBeLate = true}).reason, TrackReason::kLate);
  EXPECT_EQ(judged({.mayBeLate = true}).reason, TrackReason::kMayBeLate);
  for (const Signs& signs :
       {Signs{.isFrozen = true}, Signs{.silence = 9.0}, Signs{.lead = 5.0}, Signs{.unusual = 2},
        Signs{.trustsOdometry = false}, Signs{.isLate = true}, Signs{.mayBeLate = true}})
    EXPECT_EQ(judged(signs).status, TrackStatus::kUncertain);
}

TEST(Judge, IsLostWhereReadingsDoNotFit) {
  const PoseEstimate estimate = judged({.fitLately = 0.4, .unusual = 5, .lead = 12.0});
  EXPECT_EQ(estimate.status, TrackStatus::kLost);
  EXPECT_LT(estimate.quality, 0.2);
}

TEST(Judge, TellsSeveralPlacesFromAWideOne) {
  PoseEstimate half = narrow();
  half.share = 0.5;
  EXPECT_EQ(judged({}, half).reason, TrackReason::kSeveralPlaces);
  PoseEstimate wide = narrow();
  wide.covariance = covarianceOf(1.0, 0, 1.0);
  EXPECT_EQ(judged({}, wide).reason, TrackReason::kSpread);
  EXPECT_NE(judged({}, wide).status, TrackStatus::kTracking);
}

// Below even the odds of a belief count with one factor, whatever its width: those of the closed
// form for twice the covariance. Above even they say nothing more.
TEST(Judge, TheCovarianceCountsTwice) {
  const auto odds = [](double p) { return std::log(p / (1.0 - p)); };
  const auto claimed = [&](double sigma) {
    PoseEstimate estimate = narrow();
    estimate.share = 1.0;
    estimate.covariance = covarianceOf(sigma * sigma, 0, sigma * sigma);
    return odds(judged({}, estimate).quality);
  };
  const auto doubled = [&](double sigma) {
    return odds(1.0 - std::exp(-0.25 / (2.0 * 2.0 * sigma * sigma)));
  };
  const double factor = (claimed(0.5) - claimed(0.6)) / (doubled(0.5) - doubled(0.6));
  EXPECT_NEAR((claimed(0.6) - claimed(1.5)) / (doubled(0.6) - doubled(1.5)), factor, 0.01);
  EXPECT_NEAR((claimed(1.5) - claimed(9.0)) / (doubled(1.5) - doubled(9.0)), factor, 0.01);
  EXPECT_GT(factor, 0.0);
  EXPECT_NEAR(claimed(0.1), claimed(0.3), 1e-9);
}

TEST(Judge, AnEndlessLeadCountsNoMoreThanOneThatTakesOver) {
  EXPECT_DOUBLE_EQ(judged({.lead = 16.0}).quality, judged({.lead = 1e6}).quality);
  EXPECT_LT(judged({.lead = 16.0}).quality, judged({.lead = 15.0}).quality);
}

TEST(Judge, IsLostExactlyWhereAnErrorIsMoreLikelyThanNot) {
  int lost = 0;
  for (int i = 0; i <= 1000; ++i) {
    const PoseEstimate estimate = judged({.fitLately = 0.001 * i, .lead = 12.0});
    EXPECT_EQ(estimate.status == TrackStatus::kLost, estimate.quality < 0.5) << i;
    if (estimate.status == TrackStatus::kLost) ++lost;
  }
  EXPECT_GT(lost, 0);
  EXPECT_LT(lost, 1000);
}

// Of halls that look alike from both ends each may be the right one.
TEST(Judge, IsNoSurerThanThatThePlaceIsTheRightOne) {
  for (const double share : {0.1, 0.5, 0.9, 0.999}) {
    PoseEstimate shared = narrow();
    shared.share = share;
    const PoseEstimate estimate = judged({}, shared);
    EXPECT_LE(estimate.quality, share);
    EXPECT_GT(estimate.quality, 0.99 * share);
  }
}

TEST(Judge, DoesNotRelyOnABeliefWiderThanEvenOdds) {
  const auto statusOf = [](double sigma) {
    PoseEstimate wide = narrow();
    wide.covariance = covarianceOf(sigma * sigma, 0, sigma * sigma);
    return judged({}, wide).status;
  };
  // 0.5 m are within so many sigmas of twice the variance with even odds.
  const double even = 0.5 / std::sqrt(4.0 * std::log(2.0));
  EXPECT_EQ(statusOf(0.99 * even), TrackStatus::kTracking);
  EXPECT_EQ(statusOf(1.01 * even), TrackStatus::kUncertain);
  EXPECT_EQ(statusOf(20.0), TrackStatus::kLost);
}

TEST(Judge, QualityFallsWithEverySign) {
  const double best = judged({}).quality;
  EXPECT_LT(judged({.unusual = 1}).quality, best);
  EXPECT_LT(judged({.isConfirmed = false}).quality, best);
  EXPECT_LT(judged({.fitLately = 0.8}).quality, best);
  EXPECT_LT(judged({.lead = 8.0}).quality, best);
  PoseEstimate shared = narrow();
  shared.share = 0.7;
  EXPECT_LT(judged({}, shared).quality, best);
}

// The long axis of the position counts, whatever its direction.
TEST(Judge, ProtectsAlongTheLongAxis) {
  for (const double angle : {0.0, 0.4, 1.3, 0.5 * std::numbers::pi}) {
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    PoseEstimate estimate = narrow();
    estimate.covariance = covarianceOf(1e-4 * c * c + 1e-6 * s * s, (1e-4 - 1e-6) * c * s,
                                       1e-4 * s * s + 1e-6 * c * c);
    const PoseEstimate tracking = judged({}, estimate);
    ASSERT_EQ(tracking.status, TrackStatus::kTracking);
    EXPECT_NEAR(tracking.protection.metres, 4.2 * 0.01, 1e-9) << angle;
    EXPECT_NEAR(tracking.protection.radians, 4.2 * 0.1, 1e-9);
    // One in a hundred may be beyond it, instead of one in a thousand.
    const PoseEstimate uncertain = judged({.isLate = true}, estimate);
    ASSERT_EQ(uncertain.status, TrackStatus::kUncertain);
    EXPECT_NEAR(uncertain.protection.metres, 3.3 * 0.01, 1e-9) << angle;
    EXPECT_NEAR(uncertain.protection.radians, 3.3 * 0.1, 1e-9);
  }
}

TEST(Judge, ProtectsOverWhatOdometrySaysAndAsFarAsTheBeliefReaches) {
  const double alone = judged({}).protection.metres;
  EXPECT_NEAR(judged({.apart = {0.3, 0.2}}).protection.metres, alone + 0.3, 1e-9);
  EXPECT_NEAR(judged({.apart = {0.3, 0.2}}).protection.radians, 0.42 + 0.2, 1e-9);
  EXPECT_NEAR(judged({.others = PoseDistance{7.0, 2.0}}).protection.metres, 7.0, 1e-9);
  EXPECT_NEAR(judged({.others = PoseDistance{7.0, 2.0}}).protection.radians, 2.0, 1e-9);
  EXPECT_NEAR(judged({.others = PoseDistance{0.5 * alone, 0.1}}).protection.metres, alone, 1e-9);
  EXPECT_EQ(judged({.apart = {0.0, 9.0}}).protection.radians, std::numbers::pi);
  // Where it is not known how far the belief reaches, all of it has to be at one place.
  PoseEstimate most = narrow();
  most.share = 0.998;
  ASSERT_EQ(judged({}, most).status, TrackStatus::kTracking);
  EXPECT_TRUE(std::isinf(judged({}, most).protection.metres));
  EXPECT_NEAR(judged({.others = PoseDistance{0.3, 0.1}}, most).protection.metres, 0.3, 1e-9);
  EXPECT_NEAR(judged({.isLate = true}, most).protection.metres, 3.3 * 0.05, 1e-9);
  most.share = 0.98;
  EXPECT_TRUE(std::isinf(judged({.isLate = true}, most).protection.metres));
}

TEST(Judge, NothingBoundsTheErrorWhereOtherPlacesMayBeRight) {
  for (const Signs& signs : {Signs{.isFrozen = true}, Signs{.unusual = 1}, Signs{.lead = 4.0},
                             Signs{.isConfirmed = false}, Signs{.unusual = 1, .silence = 9.0},
                             Signs{.fitLately = 0.4, .unusual = 5, .lead = 12.0}}) {
    EXPECT_TRUE(std::isinf(judged(signs).protection.metres));
    EXPECT_TRUE(std::isinf(judged(signs).protection.radians));
  }
  EXPECT_TRUE(std::isinf(PoseEstimate().protection.metres));
  for (const Signs& signs : {Signs{}, Signs{.lead = 3.9}, Signs{.silence = 9.0},
                             Signs{.trustsOdometry = false}, Signs{.isLate = true}})
    EXPECT_TRUE(std::isfinite(judged(signs).protection.metres));
}

}  // namespace
}  // namespace ortung
