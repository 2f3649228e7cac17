#include "Confidence.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "BeliefTuning.hpp"

namespace ortung {
namespace {

using namespace tuning::confidence;

double square(double v) { return v * v; }

/// Returns the standard deviation along the long axis of a position.
double longSigma(const PoseCovariance& covariance) {
  const double off = std::hypot(0.5 * (covariance[0] - covariance[4]), covariance[1]);
  return std::sqrt(std::max(0.0, 0.5 * positionVariance(covariance) + off));
}

/// Returns the probability that the position is right by the covariance alone.
double within(const PoseEstimate& estimate) {
  PoseCovariance wide = estimate.covariance;
  for (double& c : wide) c *= kInflation;
  return std::clamp(probabilityWithin(wide, kRight), 1e-6, 1.0 - 1e-6);
}

/// Returns what speaks against an estimate first, whose share and quality are set.
/// @param narrow within() of the estimate
TrackReason reasonFor(const Signs& signs, const PoseEstimate& estimate, double narrow) {
  if (signs.isFrozen) return TrackReason::kFrozen;
  if (!signs.silence || *signs.silence > tuning::common::kLongGap) return TrackReason::kNoReading;
  if (signs.isLate) return TrackReason::kLate;
  // So at least two readings agree.
  if (signs.lead >= tuning::lead::kMostNatsOfAReading) return TrackReason::kRival;
  if (signs.unusual > 0) return TrackReason::kPoorFit;
  if (estimate.share < kOfOnePlace) return TrackReason::kSeveralPlaces;
  if (!signs.isConfirmed) return TrackReason::kUnconfirmed;
  if (signs.mayBeLate) return TrackReason::kMayBeLate;
  // The stamps of the readings may be wrong instead.
  if (!signs.trustsOdometry) return TrackReason::kOdometry;
  const bool isSpread = estimate.quality < kTracking || narrow < kSpread;
  return isSpread ? TrackReason::kSpread : TrackReason::kFits;
}

/// Returns whether something speaks for other places, and nothing says how far away they are.
bool isAnywhere(const Signs& signs, const PoseEstimate& estimate) {
  return estimate.status == TrackStatus::kLost || signs.isFrozen || signs.unusual > 0 ||
         signs.lead >= tuning::lead::kMostNatsOfAReading || !signs.isConfirmed;
}

/// Returns the protection level: it reaches over the errors that the covariance explains and over
/// what odometry would have it, or, if that is farther, to all but a small share of the belief.
PoseDistance protectionOf(const Signs& signs, const PoseEstimate& estimate) {
  const bool tracks = estimate.status == TrackStatus::kTracking;
  const bool isOnePlace = estimate.share >= 1.0 - (tracks ? kBeyondTracking : kBeyondUncertain);
  if (isAnywhere(signs, estimate) || (!signs.others && !isOnePlace)) return kUnbounded;
  const PoseDistance samples = signs.others.value_or(PoseDistance());
  const PoseDistance others = {std::max(samples.metres, signs.alike.metres),
                               std::max(samples.radians, signs.alike.radians)};
  const double sigmas =
      tracks ? tuning::protection::kSigmasTracking : tuning::protection::kSigmasUncertain;
  return {
      std::max(others.metres, sigmas * longSigma(estimate.covariance) + signs.apart.metres),
      std::min(std::numbers::pi,
               std::max(others.radians, sigmas * std::sqrt(headingVariance(estimate.covariance)) +
                                            signs.apart.radians))};
}

}  // namespace

double probabilityWithin(const PoseCovariance& covariance, double metres) {
  const double middle = 0.5 * positionVariance(covariance);
  const double off = std::hypot(0.5 * (covariance[0] - covariance[4]), covariance[1]);
  const double wide = std::sqrt(std::max(middle + off, 1e-12));
  const double narrow = std::sqrt(std::max(middle - off, 1e-12));
  // The integral across the long axis has a closed form, so that narrow Gaussians are integrated
  // accurately, too: P = E[erf(half chord / (narrow sqrt 2))], by the midpoint rule along the long
  // axis.
  constexpr int kSteps = 64;
  const double reach = std::min(metres, 6.0 * wide);
  const double step = 2.0 * reach / kSteps;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double x = -reach + (i + 0.5) * step;
    const double chord = std::sqrt(std::max(0.0, metres * metres - x * x));
    sum += std::exp(-0.5 * square(x / wide)) * std::erf(chord / (narrow * std::numbers::sqrt2));
  }
  return std::min(1.0, sum * step / (wide * std::sqrt(2.0 * std::numbers::pi)));
}

void judge(const Signs& signs, PoseEstimate& estimate) {
  estimate.share = std::min(estimate.share, signs.shareOfAlike);
  const double narrow = within(estimate);
  // Beyond even odds the covariance says nothing more of whether the place is right.
  const double oddsWithin = std::min(0.0, std::log(narrow / (1.0 - narrow)));
  const double fitLately = std::clamp(signs.fitLately, 0.0, 1.0);
  // With more the other place takes over.
  const double lead = std::clamp(signs.lead, 0.0, tuning::lead::kEnoughNats);
  const double unconfirmed = signs.isConfirmed ? 0.0 : 1.0;
  const double unusual = signs.unusual > 0 ? 1.0 : 0.0;
#ifdef ORTUNG_SWEEP
  noteSigns({static_cast<double>(estimate.stamp), estimate.pose.x, estimate.pose.y, oddsWithin,
             fitLately, lead, unconfirmed, unusual, estimate.share});
#endif
  const double odds = kConstant + kOfBelief * oddsWithin + kOfFitLately * fitLately +
                      kOfLead * lead + kOfUnconfirmed * unconfirmed + kOfUnusual * unusual;
  estimate.quality = estimate.share / (1.0 + std::exp(-odds));
  estimate.reason = reasonFor(signs, estimate, narrow);
  estimate.status = estimate.quality < kLost                ? TrackStatus::kLost
                    : estimate.reason == TrackReason::kFits ? TrackStatus::kTracking
                                                            : TrackStatus::kUncertain;
  estimate.protection = protectionOf(signs, estimate);
}

}  // namespace ortung
