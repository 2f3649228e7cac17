#pragma once

#include "Constant.hpp"

/// Constants of the folder belief: how far an estimate can be trusted, and what counts as evidence
/// for another place. Each comment says what the constant is, its unit, and where its value comes
/// from; docs/constants.md shows what changes on recordings if it is halved or doubled.
namespace ortung::tuning {

/// Confidence: how far an estimate can be trusted.
namespace confidence {

/// [m] Greatest position error that counts as right. Chosen by hand: the size of a typical robot.
ORTUNG_CONSTANT(confidence, kRight, 0.5);
/// Factor by which the covariance is inflated, since the reference, the map and the sensor models
/// have errors, too. Fitted: confidence.
ORTUNG_CONSTANT(confidence, kInflation, 2.0);
/// [nats] Constant term of the log-odds that the position is right. Fitted: confidence.
ORTUNG_CONSTANT(confidence, kConstant, -8.0);
/// Coefficient of the log-odds that follow from share and covariance alone. Fitted: confidence.
ORTUNG_CONSTANT(confidence, kOfBelief, 0.65);
/// [nats] Coefficient of the fit of the newest readings. Fitted: confidence.
ORTUNG_CONSTANT(confidence, kOfFit, 5.5);
/// [nats] Coefficient of the short-term average of the fit. Fitted: confidence.
ORTUNG_CONSTANT(confidence, kOfFitLately, 4.4);
/// Coefficient of the lead of another place over the belief, per nat. Fitted: confidence.
ORTUNG_CONSTANT(confidence, kOfLead, -0.12);
/// [nats] Greatest lead that counts, since at lead::kEnoughNats the other place takes over.
ORTUNG_CONSTANT(confidence, kMostLead, 16.0);
/// [share] Least quality of an estimate that may be relied on. Chosen by hand: one in ten may be
/// wrong.
ORTUNG_CONSTANT(confidence, kTracking, 0.9);
/// [share] Quality below which the status is "lost": the estimate is more probably wrong than
/// right.
ORTUNG_CONSTANT(confidence, kLost, 0.5);
/// [nats] Lead of another place that makes the belief uncertain: the most that one reading can
/// count.
ORTUNG_CONSTANT(confidence, kRivalNats, 4.0);
/// [share] If the heaviest place has less than this share of the belief, the pose is ambiguous.
/// Chosen by hand.
ORTUNG_CONSTANT(confidence, kOfOnePlace, 0.8);
/// A silence is reported if it is this many times longer than the usual time between readings.
/// Chosen by hand.
ORTUNG_CONSTANT(confidence, kLongSilence, 3.0);

}  // namespace confidence

/// Lead: a sequential test of whether readings support another place than the belief's.
namespace lead {

/// [nats] Lead at which another place takes over: by Wald's sequential test one wrong decision in
/// e^16 tests, if readings were independent, which they are not quite.
ORTUNG_CONSTANT(lead, kEnoughNats, 16.0);
/// [nats] Lead below which another place is given up. Chosen by hand: three quarters of what is
/// enough to take over.
ORTUNG_CONSTANT(lead, kHopelessNats, -12.0);
/// [nats] Most that one reading counts, so that no single reading moves the belief: at least four
/// have to agree.
ORTUNG_CONSTANT(lead, kMostNatsOfAReading, 4.0);

}  // namespace lead

}  // namespace ortung::tuning
