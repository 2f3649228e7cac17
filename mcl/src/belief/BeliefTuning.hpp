#pragma once

#include "Constant.hpp"

/// Constants of the room belief: how far an estimate can be trusted, and what counts as evidence
/// for another place. What each one is, its unit, and where its value comes from; docs/constants.md
/// has what half of it and twice as much change on recordings.
namespace ortung::tuning {

/// Confidence: how far an estimate can be trusted.
namespace confidence {

/// [m] Error of a position that counts as right. By hand: the size of a robot of the field.
ORTUNG_CONSTANT(confidence, kRight, 0.5);
/// The covariance counts so many times, since the reference, the map and the readings' models err,
/// too. Fitted: confidence.
ORTUNG_CONSTANT(confidence, kInflation, 2.0);
/// [nats] Odds of a right position before anything is known. Fitted: confidence.
ORTUNG_CONSTANT(confidence, kConstant, -8.0);
/// What the odds by share and covariance alone count. Fitted: confidence.
ORTUNG_CONSTANT(confidence, kOfBelief, 0.65);
/// [nats] What the fit of the readings of the moment counts. Fitted: confidence.
ORTUNG_CONSTANT(confidence, kOfFit, 5.5);
/// [nats] What the fit of the readings lately counts. Fitted: confidence.
ORTUNG_CONSTANT(confidence, kOfFitLately, 4.4);
/// What each nat by which another place leads counts. Fitted: confidence.
ORTUNG_CONSTANT(confidence, kOfLead, -0.12);
/// [nats] Greatest lead that counts, since at kEnoughNats the other place is taken.
ORTUNG_CONSTANT(confidence, kMostLead, 16.0);
/// [share] Least quality of an estimate that may be relied on. By hand: one in ten may be wrong.
ORTUNG_CONSTANT(confidence, kTracking, 0.9);
/// [share] Quality below which an estimate is lost: wrong is more probable than right.
ORTUNG_CONSTANT(confidence, kLost, 0.5);
/// [nats] Lead of another place that makes the belief uncertain: as much as one reading can count.
ORTUNG_CONSTANT(confidence, kRivalNats, 4.0);
/// [share] Share of the belief at one place below which the place is ambiguous. By hand.
ORTUNG_CONSTANT(confidence, kOfOnePlace, 0.8);
/// Ratio of a silence that is reported to the usual time between readings. By hand.
ORTUNG_CONSTANT(confidence, kLongSilence, 3.0);

}  // namespace confidence

/// Lead: what readings say for another place, as a sequential test.
namespace lead {

/// [nats] Lead that is enough to leave a place: by Wald's sequential test one wrong change in e^16
/// tests, if readings were independent, which they are not quite.
ORTUNG_CONSTANT(lead, kEnoughNats, 16.0);
/// [nats] Lead below which no other place is left to be found. By hand: three quarters of what is
/// enough.
ORTUNG_CONSTANT(lead, kHopelessNats, -12.0);
/// [nats] Most that one reading counts, so that no single reading moves the belief: four have to
/// agree.
ORTUNG_CONSTANT(lead, kMostNatsOfAReading, 4.0);

}  // namespace lead

}  // namespace ortung::tuning
