#pragma once

#include <cstddef>

#include "Constant.hpp"

/// Constants of the room rivals: other places and delays beside the belief.
/// What each one is, its unit, and where its value comes from; docs/constants.md has what half of
/// it and twice as much change on recordings.
namespace ortung::tuning {

/// Hypotheses beside the belief.
namespace hypothesis {

/// [nats] Lead below which one is given up and drawn anew: seven times less probable than the
/// belief.
ORTUNG_CONSTANT(hypothesis, kDropped, -2.0);
/// [m] Least distance from the belief of another place. By hand: samples of one place lie nearer.
ORTUNG_CONSTANT(hypothesis, kSamePlace, 0.3);
/// [rad] Least turn from the belief of another place. By hand.
ORTUNG_CONSTANT(hypothesis, kSameTurn, 0.2);
/// [m] Least distance travelled over which readings are spread that confirm a place far away:
/// nearer ones can err alike.
ORTUNG_CONSTANT(hypothesis, kDistance, 1.0);

}  // namespace hypothesis

/// Rivals around the estimate: the robot slipped, or odometry lies.
namespace around {

/// [m] Initial radius of the ring. By hand: less is followed by the belief itself.
ORTUNG_CONSTANT(around, kRing, 0.5);
/// [m/s] What it grows by: as fast as wheels slip. By hand.
ORTUNG_CONSTANT(around, kRingPerSecond, 1.5);
/// [m] Largest radius: what is farther is searched for elsewhere.
ORTUNG_CONSTANT(around, kLargestRing, 3.0);
/// [rad] Initial turn to either side. By hand.
ORTUNG_CONSTANT(around, kTurn, 0.35);
/// [rad/s] What it grows by. By hand.
ORTUNG_CONSTANT(around, kTurnPerSecond, 0.35);
/// [rad] Largest turn: a quarter of a full one to either side.
ORTUNG_CONSTANT(around, kLargestTurn, 1.6);
/// [share] Share of the belief that is taken when a rival leads; the rest stays where it was. By
/// hand.
ORTUNG_CONSTANT(around, kShareTaken, 0.9);
/// Samples. Cost.
ORTUNG_CONSTANT(around, kSamples, std::size_t{400});
/// Samples that follow odometry, and as many that spread without it. Cost.
ORTUNG_CONSTANT(around, kSpread, std::size_t{1000});
/// Candidates for each sample. Cost.
ORTUNG_CONSTANT(around, kCandidates, 10.0);

}  // namespace around

/// Rivals elsewhere: the robot was carried away, or the place was wrong.
namespace elsewhere {

/// [m] Distance travelled after which a reading counts whole: walls that look alike go on for
/// longer than around a known place.
ORTUNG_CONSTANT(elsewhere, kIndependent, 0.3);
/// Least number of readings. By hand: with lead::kMostNatsOfAReading four would do.
ORTUNG_CONSTANT(elsewhere, kReadings, 5);
/// Bad readings in a row after which the place was a random hit. By hand.
ORTUNG_CONSTANT(elsewhere, kMostUnusual, 4);
/// Samples. Cost.
ORTUNG_CONSTANT(elsewhere, kSamples, std::size_t{1000});
/// Effective samples below which more are drawn around the best. By hand: a tenth.
ORTUNG_CONSTANT(elsewhere, kEffective, 100.0);
/// [nats] Places that fit so much worse than the best one are none. By hand, as
/// lead::kHopelessNats.
ORTUNG_CONSTANT(elsewhere, kSearchNats, 12.0);

}  // namespace elsewhere

/// Confirmation: of a place that a search has found.
namespace confirmation {

/// Least number of readings that confirm a place. By hand: two can be of one moment.
ORTUNG_CONSTANT(confirmation, kReadings, 3);

}  // namespace confirmation

/// Delays: how probable each one is.
namespace delays {

/// [share] Probability of any delay before anything is known. By hand: one robot in fifty.
ORTUNG_CONSTANT(delays, kLate, 0.02);
/// [1/s] Rate at which another delay begins, as probable as at first: once in three hours.
ORTUNG_CONSTANT(delays, kChanges, 1e-4);
/// [m] Errors of places beyond the model of odometry's errors. By hand: what maps and tables leave
/// open.
ORTUNG_CONSTANT(delays, kMetres, 0.05);
/// [rad] Errors of headings beyond that model. By hand.
ORTUNG_CONSTANT(delays, kRadians, 0.03);

}  // namespace delays

/// Lateness: by how much all stamps are late.
namespace lateness {

/// Samples of each delay. Cost.
ORTUNG_CONSTANT(lateness, kSamples, std::size_t{128});
/// Effective samples below which they climb. By hand: an eighth.
ORTUNG_CONSTANT(lateness, kEffective, 16.0);
/// [s] Least time between places that are compared: longer than the steps between delays.
ORTUNG_CONSTANT(lateness, kPiece, 1.0);
/// Times more probable than the delay in force: then another one is in force. By hand: Jeffreys'
/// strong evidence.
ORTUNG_CONSTANT(lateness, kStrongEvidence, 10.0);
/// [share] Probability of delays that may be left out. Cost.
ORTUNG_CONSTANT(lateness, kLeftOut, 0.005);
/// [m] Distance of two delays' places below which they are one. By hand.
ORTUNG_CONSTANT(lateness, kSamePlace, 0.5);
/// [m] Greatest distance within some seconds; else odometry's counter jumped. More than 10 m/s.
ORTUNG_CONSTANT(lateness, kFarthest, 50.0);
/// [share] Probability that is not looked at. Cost.
ORTUNG_CONSTANT(lateness, kNegligible, 1e-6);
/// [nats] Lead that is enough for a jump of odometry: half of lead::kEnoughNats, since to have no
/// delay is the rule.
ORTUNG_CONSTANT(lateness, kEnoughForNone, 8.0);
/// [nats] Most that one reading counts to tell jumps apart. By hand.
ORTUNG_CONSTANT(lateness, kMostSharp, 20.0);
/// [m + rad] Least difference of places that shows a delay. By hand: more than the errors of
/// delays::kMetres and kRadians together.
ORTUNG_CONSTANT(lateness, kPlacesApart, 0.3);
/// [m + rad] Motion after which a reading counts whole. By hand: trust::kIndependent, of both.
ORTUNG_CONSTANT(lateness, kIndependent, 0.2);
/// Ratio of a long gap between readings to the usual one. By hand.
ORTUNG_CONSTANT(lateness, kLongGap, 3.0);
/// [share] Least ratio of the usual gap to the one before. By hand.
ORTUNG_CONSTANT(lateness, kGapKept, 0.9);
/// Greatest ratio of the usual gap to the one before. By hand.
ORTUNG_CONSTANT(lateness, kGapMore, 1.5);

}  // namespace lateness

/// Recovery: whether the readings fit the belief as they usually do.
namespace recovery {

/// Samples that say how well the belief fits. Cost.
ORTUNG_CONSTANT(recovery, kWitnesses, std::size_t{64});
/// [share] Share of the long-term average below which one moment's fit is doubtful. By hand.
ORTUNG_CONSTANT(recovery, kDoubtfulFit, 0.75);
/// [share] Share of it below which the short-term average has fallen. By hand.
ORTUNG_CONSTANT(recovery, kFallenFit, 0.6);
/// [share] Share of it above which the short-term average has recovered. By hand.
ORTUNG_CONSTANT(recovery, kRecoveredFit, 0.8);
/// [share] Share of the long-term average of best fits that is still usual. By hand.
ORTUNG_CONSTANT(recovery, kUsualFit, 0.85);
/// Unusual readings in a row that call for a search: one may be random.
ORTUNG_CONSTANT(recovery, kUnusualReadings, 2);
/// [share] Rate of the long-term average while the short-term one has fallen, as a share of the
/// usual rate. By hand.
ORTUNG_CONSTANT(recovery, kRateWhileFallen, 0.1);
/// [share] Fit below which the belief always explains too little. By hand.
ORTUNG_CONSTANT(recovery, kPoorFit, 0.25);

}  // namespace recovery

}  // namespace ortung::tuning
