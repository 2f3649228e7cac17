#pragma once

#include "Constant.hpp"

/// Constants of the folder refine: biases of devices, and the refinement of the estimate. Each
/// comment says what the constant is, its unit, and where its value comes from; docs/constants.md
/// shows what changes on recordings if it is halved or doubled.
namespace ortung::tuning {

/// Biases: systematic errors of devices.
namespace biases {

/// [share] Prior sigma of the error in scale of distances: radio ranging devices have errors of up
/// to 7 %.
ORTUNG_CONSTANT(biases, kScale, 0.05);
/// [sigma] Standard errors from zero at which a bias stays known, so that it does not come and go.
/// Chosen by hand.
ORTUNG_CONSTANT(biases, kStillErrors, 1.5);
/// Least number of values from which a bias becomes known. The usual rule for means of unknown
/// distributions.
ORTUNG_CONSTANT(biases, kFewest, 30);
/// Number of values by which a bias is trusted: after that many have fitted, it outlives the place
/// at which it was learned, and so many values without a place to track make it forgotten.
ORTUNG_CONSTANT(biases, kTrusted, 300);
/// [share] Share of outliers above which the pose must be wrong, rather than the readings.
ORTUNG_CONSTANT(biases, kMisfits, 0.5);
/// [share] Rate at which the share of outliers is averaged: over fifty readings. Chosen by hand.
ORTUNG_CONSTANT(biases, kRate, 0.02);

}  // namespace biases

/// Polish: refines the estimate beyond the resolution of samples and tables.
namespace polish {

/// Greatest number of Gauss-Newton steps. Cost.
ORTUNG_CONSTANT(polish, kMostSteps, 8);
/// [m] Accuracy in position to which a cluster's mean is known; it is added to its covariance.
ORTUNG_CONSTANT(polish, kClusterMetres, 0.03);
/// [rad] Accuracy in heading to which a cluster's mean is known; it is added to its covariance.
ORTUNG_CONSTANT(polish, kClusterRadians, 0.02);
/// [share] Directions in which readings remove less than this share of the variance give no
/// innovation. Chosen by hand.
ORTUNG_CONSTANT(polish, kLeastRemoved, 0.1);
/// [share] If readings leave less than this share of the predicted variance in a direction, the
/// innovation there is due to the motion alone and says nothing about the readings. Chosen by hand.
ORTUNG_CONSTANT(polish, kPredicted, 0.02);
/// Ratio of squared innovations to expected ones below which estimates are consistent. Chosen by
/// hand.
ORTUNG_CONSTANT(polish, kConsistentRatio, 2.0);
/// Ratio of squared innovations to expected ones that may still be random. Chosen by hand.
ORTUNG_CONSTANT(polish, kRandomRatio, 1.5);
/// Greatest ratio of a squared innovation to the usual one that counts: 3 sigma.
ORTUNG_CONSTANT(polish, kMostTimes, 9.0);
/// [share] Rate at which squared innovations are averaged, over twenty updates; faster at first.
/// Chosen by hand.
ORTUNG_CONSTANT(polish, kRate, 0.05);
/// Initial ratio of squared innovations to expected ones, before there are any: a cautious value.
/// Chosen by hand.
ORTUNG_CONSTANT(polish, kTimesAtFirst, 10.0);

}  // namespace polish

/// Separation: how far estimates are from where odometry has led to.
namespace separation {

/// [share] Share of a separation that is left after an update, so that it counts for some ten of
/// them. With 0.98, logs with bad odometry had levels up to 1.7 times as wide, and stamps that
/// become late, which take longer to be found, were covered hardly better.
ORTUNG_CONSTANT(separation, kKept, 0.9);

}  // namespace separation

/// Steps: corrections of the smooth pose.
namespace steps {

/// [s] Time in which a correction is blended in to all but 1/e. Chosen by hand: a correction of
/// 0.10 m changes the speed of the smooth pose by 0.2 m/s at most.
ORTUNG_CONSTANT(steps, kBlend, 0.5);

}  // namespace steps

}  // namespace ortung::tuning
