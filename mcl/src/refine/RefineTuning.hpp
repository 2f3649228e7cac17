#pragma once

#include "Constant.hpp"

/// Constants of the room refine: biases of devices, and the place that leads.
/// What each one is, its unit, and where its value comes from; docs/constants.md has what half of
/// it and twice as much change on recordings.
namespace ortung::tuning {

/// Biases: what devices get wrong always in the same way.
namespace biases {

/// [share] Biases of scale that are expected while nothing is known: radios of the field err by up
/// to 7 %.
ORTUNG_CONSTANT(biases, kScale, 0.05);
/// [sigma] Standard errors from zero at which a bias becomes known. The tail of a normal
/// distribution beyond it is 6e-5.
ORTUNG_CONSTANT(biases, kErrors, 4.0);
/// [sigma] Standard errors from zero at which a bias stays known, so that it does not come and go.
/// By hand.
ORTUNG_CONSTANT(biases, kStillErrors, 1.5);
/// Values that a bias is known by. The usual rule for means of unknown distributions.
ORTUNG_CONSTANT(biases, kFewest, 30);
/// [sigma] Greatest innovation of an inlier, and of places that are the same.
ORTUNG_CONSTANT(biases, kMostErrors, 4.0);
/// [share] Share of outliers above which the place is wrong, not the readings.
ORTUNG_CONSTANT(biases, kMisfits, 0.5);
/// [m] Readings of a feature from places nearer to each other than this err alike. By hand, as
/// elsewhere::kIndependent.
ORTUNG_CONSTANT(biases, kApart, 0.3);
/// [share] Rate at which the share of outliers is averaged: over fifty readings. By hand.
ORTUNG_CONSTANT(biases, kRate, 0.02);

}  // namespace biases

/// Polish: the place that leads, finer than samples and tables.
namespace polish {

/// Most steps of Gauss-Newton. Cost.
ORTUNG_CONSTANT(polish, kMostSteps, 8);
/// [sigma] Greatest distance of a cluster and a pose that are one place.
ORTUNG_CONSTANT(polish, kMostSigmas, 4.0);
/// [m] Least sigma of a cluster's position for that: its mean is no better known.
ORTUNG_CONSTANT(polish, kClusterMetres, 0.03);
/// [rad] Least sigma of a cluster's heading for that.
ORTUNG_CONSTANT(polish, kClusterRadians, 0.02);
/// [share] Directions in which readings remove less than this share of the uncertainty have no
/// innovation. By hand.
ORTUNG_CONSTANT(polish, kLeastRemoved, 0.1);
/// [share] Where readings are so much narrower than the prediction, all of an innovation is the
/// motion's: it says nothing about the readings. By hand.
ORTUNG_CONSTANT(polish, kPredicted, 0.02);
/// Estimates are consistent if squared innovations are not so many times larger than expected. By
/// hand.
ORTUNG_CONSTANT(polish, kConsistentRatio, 2.0);
/// Ratio of squared innovations to expected ones that may be random. By hand.
ORTUNG_CONSTANT(polish, kRandomRatio, 1.5);
/// Most that an innovation counts, in usual ones: 3 sigma.
ORTUNG_CONSTANT(polish, kMostTimes, 9.0);
/// [share] Rate at which innovations are averaged, over twenty updates; faster at first. By hand.
ORTUNG_CONSTANT(polish, kRate, 0.05);
/// How many times larger than expected squared innovations count before there are any: cautious. By
/// hand.
ORTUNG_CONSTANT(polish, kTimesAtFirst, 10.0);

}  // namespace polish

}  // namespace ortung::tuning
