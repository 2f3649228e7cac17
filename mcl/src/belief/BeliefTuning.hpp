#pragma once

#include "Constant.hpp"

/// Constants of the folder belief: how far an estimate can be trusted, and what counts as evidence
/// for another place. Each comment says what the constant is, its unit, and where its value comes
/// from; docs/constants.md shows what changes on recordings if it is halved or doubled.
namespace ortung::tuning {

/// What several folders ask of deviations, times and places.
namespace common {

/// [sigma] Deviation beyond which a value is no noise: the tail of a normal distribution beyond it
/// is 6e-5.
ORTUNG_CONSTANT(common, kOutlier, 4.0);
/// Ratio to the usual time between readings above which a gap is long. Chosen by hand.
ORTUNG_CONSTANT(common, kLongGap, 3.0);
/// [m] Extent of one place: what is farther apart is at two. Chosen by hand: the width of a wide
/// peak of a laser's likelihood.
ORTUNG_CONSTANT(common, kPlaceMetres, 0.5);
/// [m] Radius around a place that a search has found in which samples are drawn.
inline const double kPlaceRadius = kPlaceMetres / 2;
/// [rad] Extent of one place in heading. Chosen by hand.
ORTUNG_CONSTANT(common, kPlaceRadians, 0.35);
/// [m] Distance travelled after which a reading counts fully where little is known of the place or
/// the device, since the errors of nearer ones are correlated. Chosen by hand.
ORTUNG_CONSTANT(common, kIndependent, 0.3);

}  // namespace common

/// Confidence: how far an estimate can be trusted.
namespace confidence {

/// [m] Greatest position error that counts as right. Chosen by hand: the size of a typical robot.
ORTUNG_CONSTANT(confidence, kRight, 0.5);
/// Factor by which the covariance is inflated, since the reference, the map and the sensor models
/// have errors, too. Fitted: confidence.
ORTUNG_CONSTANT(confidence, kInflation, 2.0);
/// [nats] Constant term of the log-odds that the position is right if the robot is at the heaviest
/// place at all. Fitted: confidence.
ORTUNG_CONSTANT(confidence, kConstant, 3.6);
/// Coefficient of the log-odds that follow from the covariance alone, where these are below even.
/// Fitted: confidence.
ORTUNG_CONSTANT(confidence, kOfBelief, 1.0);
/// [nats] Coefficient of the short-term average of the fit. Fitted: confidence.
ORTUNG_CONSTANT(confidence, kOfFitLately, 4.5);
/// Coefficient of the lead of another place over the belief, per nat. Fitted: confidence.
ORTUNG_CONSTANT(confidence, kOfLead, -0.49);
/// [nats] What it counts that few readings have confirmed a place yet. Fitted: confidence.
ORTUNG_CONSTANT(confidence, kOfUnconfirmed, -2.6);
/// [nats] What it counts that the newest readings fit worse than usual. Fitted: confidence.
ORTUNG_CONSTANT(confidence, kOfUnusual, -2.1);
/// [share] Least quality of an estimate that may be relied on. Chosen by hand: one in ten may be
/// wrong.
ORTUNG_CONSTANT(confidence, kTracking, 0.9);
/// [share] Probability by the covariance alone below which an estimate may not be relied on,
/// be it that such ones have mostly been right. Chosen by hand: even odds.
ORTUNG_CONSTANT(confidence, kSpread, 0.5);
/// [share] Quality below which the status is "lost": the estimate is more probably wrong than
/// right.
ORTUNG_CONSTANT(confidence, kLost, 0.5);
/// [share] If the heaviest place has less than this share of the belief, the pose is ambiguous.
/// Chosen by hand.
ORTUNG_CONSTANT(confidence, kOfOnePlace, 0.8);

}  // namespace confidence

/// Protection: the bound that an error exceeds rarely.
namespace protection {

/// [sigma] Standard deviations along the long axis beyond which an error is with the probability
/// 0.001. A normal distribution would have 3.3 (errors in one direction) to 3.7 (in both alike);
/// the errors' tails are heavier. Chosen on simulated drives: with 3.7, three in eight of a scanner
/// without a fault were beyond it once, with 4.2 none.
ORTUNG_CONSTANT(protection, kSigmasTracking, 4.2);
/// [sigma] The same with the probability 0.01, for which a normal distribution would have 2.6 to
/// 3.0.
ORTUNG_CONSTANT(protection, kSigmasUncertain, 3.3);

}  // namespace protection

/// Lead: a sequential test of whether readings support another place than the belief's.
namespace lead {

/// [nats] Lead at which another place takes over: by Wald's sequential test one wrong decision in
/// e^16 tests, if readings were independent, which they are not quite.
ORTUNG_CONSTANT(lead, kEnoughNats, 16.0);
/// [nats] Lead that is enough to return to what is the rule: odometry that is right, stamps without
/// delay.
inline const double kEnoughForRule = kEnoughNats / 2;
/// [nats] Lead below which another place is given up. Chosen by hand: three quarters of what is
/// enough to take over.
ORTUNG_CONSTANT(lead, kHopelessNats, -12.0);
/// [nats] Most that one reading counts, so that no single reading moves the belief: at least four
/// have to agree.
ORTUNG_CONSTANT(lead, kMostNatsOfAReading, 4.0);
/// [nats] Most that one reading counts for a place that alone in the whole field explains a reading
/// as well as usual: two have to agree, also if there are two such places. A search with each scan
/// of seven logs of buildings found no wrong place that alone explained one as well as usual.
ORTUNG_CONSTANT(lead, kMostNatsIfUnique, 9.0);

}  // namespace lead

}  // namespace ortung::tuning
