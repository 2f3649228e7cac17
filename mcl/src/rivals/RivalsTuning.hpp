#pragma once

#include <cstddef>

#include "Constant.hpp"

/// Constants of the folder rivals: alternative hypotheses of place and delay beside the belief.
/// Each comment says what the constant is, its unit, and where its value comes from;
/// docs/constants.md shows what changes on recordings if it is halved or doubled.
namespace ortung::tuning {

/// Hypotheses beside the belief.
namespace hypothesis {

/// [nats] Lead below which a hypothesis is given up and drawn anew: seven times less probable than
/// the belief.
ORTUNG_CONSTANT(hypothesis, kDropped, -2.0);
/// [m] Least distance of another place from the belief. Chosen by hand: samples of one place are
/// nearer to each other.
ORTUNG_CONSTANT(hypothesis, kSamePlace, 0.3);
/// [rad] Least difference in heading of another place from the belief. Chosen by hand.
ORTUNG_CONSTANT(hypothesis, kSameTurn, 0.2);
/// [m] Least distance travelled over which the readings that confirm a place far away are spread,
/// since the errors of nearer ones are correlated.
ORTUNG_CONSTANT(hypothesis, kDistance, 1.0);

}  // namespace hypothesis

/// Hypotheses around the estimate: wheels slipped, or odometry is wrong.
namespace around {

/// [m/s] Rate at which the radius grows: as fast as wheels slip. Chosen by hand.
ORTUNG_CONSTANT(around, kRingPerSecond, 1.5);
/// [m] Largest radius: the search of the whole field finds places farther away.
ORTUNG_CONSTANT(around, kLargestRing, 3.0);
/// [rad/s] Rate at which the range of headings grows. Chosen by hand.
ORTUNG_CONSTANT(around, kTurnPerSecond, 0.35);
/// [rad] Largest range of headings: a quarter of a full turn to either side.
ORTUNG_CONSTANT(around, kLargestTurn, 1.6);
/// [share] Share of the belief that a hypothesis gets when it takes over; the rest stays where it
/// was. Chosen by hand.
ORTUNG_CONSTANT(around, kShareTaken, 0.9);
/// Samples. Cost.
ORTUNG_CONSTANT(around, kSamples, std::size_t{400});
/// Number of samples that follow odometry; as many spread by process noise. Cost.
ORTUNG_CONSTANT(around, kSpread, std::size_t{1000});
/// Candidates for each sample. Cost.
ORTUNG_CONSTANT(around, kCandidates, 10.0);
/// [share] Least share of the candidates, and of the samples that follow odometry or spread, with
/// which a hypothesis is worth while if there is not time for all. Chosen by hand.
ORTUNG_CONSTANT(around, kLeastShare, 0.4);

}  // namespace around

/// Hypotheses elsewhere: the robot was kidnapped, or the belief was wrong.
namespace elsewhere {

/// Least number of readings before a takeover. Chosen by hand: with lead::kMostNatsOfAReading four
/// would be enough.
ORTUNG_CONSTANT(elsewhere, kReadings, 5);
/// [share] Share of the best place's fit from which another place explains readings about as well.
/// Chosen by hand: with 0.8 a fifth fewer scans of buildings are of one place alone, with 0.96 that
/// is the wrong place for the first time.
ORTUNG_CONSTANT(elsewhere, kAsWell, 0.9);
/// [share] Least fit of readings that count more than others do. Chosen by hand: where people stand
/// around the robot from the start scans that fit badly are usual, and two thirds of those that fit
/// at one wrong place alone fit worse than this, without people hardly any.
ORTUNG_CONSTANT(elsewhere, kWell, 0.75);
/// Number of readings in a row that fit worse than usual after which the place counts as a random
/// match. Chosen by hand.
ORTUNG_CONSTANT(elsewhere, kMostUnusual, 4);
/// Samples. Cost.
ORTUNG_CONSTANT(elsewhere, kSamples, std::size_t{1000});
/// Effective sample size below which the hypothesis is annealed. Chosen by hand: a tenth.
ORTUNG_CONSTANT(elsewhere, kEffective, 100.0);
/// [share] Least share of the samples with which a hypothesis is drawn, and annealed, if there is
/// not time for all. Chosen by hand.
ORTUNG_CONSTANT(elsewhere, kLeastShare, 0.1);

}  // namespace elsewhere

/// Places that look like the belief's.
namespace lookalikes {

/// [nats] Evidence beyond chance from which a place is ruled out: 3,000 times less probable.
ORTUNG_CONSTANT(lookalikes, kRuledOut, -8.0);
/// Standard deviations by which sums of ratios differ from 0 by chance. Chosen by hand: the sum of
/// some hundred is never that far away.
ORTUNG_CONSTANT(lookalikes, kDeviations, 4.0);
/// [nats^2] Variance of a sum of ratios beside what they have shown so far. Chosen by hand.
ORTUNG_CONSTANT(lookalikes, kChance, 0.25);
/// Number of readings over which ratios are summed.
ORTUNG_CONSTANT(lookalikes, kRemembered, 100.0);
/// [m] Standard deviation of the steps in which a place climbs: errors of odometry between
/// readings. Chosen by hand.
ORTUNG_CONSTANT(lookalikes, kMetres, 0.1);
/// [rad] The same for its heading.
ORTUNG_CONSTANT(lookalikes, kRadians, 0.05);
/// Steps that are tried. Cost.
ORTUNG_CONSTANT(lookalikes, kTried, std::size_t{48});
/// Greatest number of places that are followed. Cost.
ORTUNG_CONSTANT(lookalikes, kMost, std::size_t{8});
/// [share] Least share of the belief of a place that is followed. Chosen by hand.
ORTUNG_CONSTANT(lookalikes, kLeastShare, 0.02);

}  // namespace lookalikes

/// Sightings of a place by several searches.
namespace sightings {

/// [share] Distance between where a search has found a place and where odometry led to from the
/// last one, as a share of the distance travelled, at which they agree: at half of it a place that
/// came along with the robot, or stayed behind, is not nearer.
ORTUNG_CONSTANT(sightings, kAgrees, 0.5);

}  // namespace sightings

/// Confirmation of a place that a search has found.
namespace confirmation {

/// Least number of readings that confirm a place. Chosen by hand: two can be of one time step.
ORTUNG_CONSTANT(confirmation, kReadings, 3);

}  // namespace confirmation

/// Delays: how probable each one is.
namespace delays {

/// [share] Prior probability that there is any delay. Chosen by hand: one robot in fifty.
ORTUNG_CONSTANT(delays, kLate, 0.02);
/// [1/s] Rate at which the delay changes, to any one by the prior: once in three hours.
ORTUNG_CONSTANT(delays, kChanges, 1e-4);
/// [m] Sigma of position errors that is added to the motion model's. Chosen by hand: the accuracy
/// of maps and tables.
ORTUNG_CONSTANT(delays, kMetres, 0.05);
/// [rad] Sigma of heading errors that is added to the motion model's. Chosen by hand.
ORTUNG_CONSTANT(delays, kRadians, 0.03);

}  // namespace delays

/// Lateness: the delay of the stamps of all readings.
namespace lateness {

/// Number of samples of the hypothesis of each delay. Cost.
ORTUNG_CONSTANT(lateness, kSamples, std::size_t{128});
/// Effective sample size below which they are annealed. Chosen by hand: an eighth.
ORTUNG_CONSTANT(lateness, kEffective, 16.0);
/// [s] Least time between the estimates that are compared: longer than the steps between delays.
ORTUNG_CONSTANT(lateness, kPiece, 1.0);
/// Ratio of probabilities at which another delay replaces the one in force. Chosen by hand:
/// Jeffreys' strong evidence.
ORTUNG_CONSTANT(lateness, kStrongEvidence, 10.0);
/// Ratio of the probability of delays to their prior at which readings have told of one. Chosen by
/// hand.
ORTUNG_CONSTANT(lateness, kTold, 2.0);
/// [share] Total probability of delays that may be left out. Cost.
ORTUNG_CONSTANT(lateness, kLeftOut, 0.005);
/// [m] Greatest distance travelled within some seconds; beyond it odometry's counter jumped. More
/// than 10 m/s.
ORTUNG_CONSTANT(lateness, kFarthest, 50.0);
/// [share] Probability of a delay below which it is ignored. Cost.
ORTUNG_CONSTANT(lateness, kNegligible, 1e-6);
/// [nats] Most that one reading counts to distinguish changes to different delays. Chosen by hand.
ORTUNG_CONSTANT(lateness, kMostSharp, 20.0);
/// [m + rad] Least difference of poses by which delays are distinguished. Chosen by hand: more than
/// the errors of delays::kMetres and kRadians together.
ORTUNG_CONSTANT(lateness, kPlacesApart, 0.3);
/// [m + rad] Motion after which a reading counts fully. Chosen by hand: trust::kIndependent, for
/// distance and turn together.
ORTUNG_CONSTANT(lateness, kIndependent, 0.2);
/// [share] Least ratio of the usual gap to its last value, so that it falls over ten updates.
/// Chosen by hand.
ORTUNG_CONSTANT(lateness, kUsualKept, 0.9);
/// Greatest ratio of the usual gap to its last value. Chosen by hand.
ORTUNG_CONSTANT(lateness, kGapMore, 1.5);

}  // namespace lateness

/// Recovery: whether the readings fit the belief as they usually do.
namespace recovery {

/// Number of samples from which the fit of the belief is computed. Cost.
ORTUNG_CONSTANT(recovery, kWitnesses, std::size_t{64});
/// [share] Share of the long-term average below which the fit of one time step is doubtful. Chosen
/// by hand.
ORTUNG_CONSTANT(recovery, kDoubtfulFit, 0.75);
/// [share] Share of the long-term average below which the short-term average has fallen. Chosen by
/// hand.
ORTUNG_CONSTANT(recovery, kFallenFit, 0.6);
/// [share] Share of the long-term average above which the short-term average has recovered. Chosen
/// by hand.
ORTUNG_CONSTANT(recovery, kRecoveredFit, 0.8);
/// [share] Share of the long-term average of best fits above which a best fit is still usual.
/// Chosen by hand.
ORTUNG_CONSTANT(recovery, kUsualFit, 0.85);
/// Number of usual deviations by which a best fit may be below the usual one, where readings
/// scatter that much.
ORTUNG_CONSTANT(recovery, kScatters, 3.0);
/// [share] Greatest deviation that counts as one of a usual reading.
ORTUNG_CONSTANT(recovery, kMostScatter, 0.25);
/// Number of readings in a row that fit worse than usual after which a search begins: one may be
/// random.
ORTUNG_CONSTANT(recovery, kUnusualReadings, 2);
/// [share] Rate of the long-term average while the short-term one has fallen, as a share of the
/// usual rate. Chosen by hand.
ORTUNG_CONSTANT(recovery, kRateWhileFallen, 0.1);
/// [share] Fit below which readings always count as badly explained. Chosen by hand.
ORTUNG_CONSTANT(recovery, kPoorFit, 0.25);

}  // namespace recovery

}  // namespace ortung::tuning
