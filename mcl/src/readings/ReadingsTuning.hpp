#pragma once

#include "Constant.hpp"

/// Constants of the folder readings: which readings are new, and how much time an update may take.
/// Each comment says what the constant is, its unit, and where its value comes from;
/// docs/constants.md shows what changes on recordings if it is halved or doubled.
namespace ortung::tuning {

/// Intake: which readings are new.
namespace intake {

/// [s] If stamps jump back by more than this, a clock was set, or a log began anew. Longer than the
/// delay of any device.
ORTUNG_CONSTANT(intake, kTimeJump, 5.0);
/// Number of looks in a row at which all new readings are much older than the belief, before the
/// clock counts as set back. Chosen by hand.
ORTUNG_CONSTANT(intake, kLooksBehind, 10);
/// [s] Least time over which the stamps of these readings are spread. Chosen by hand.
ORTUNG_CONSTANT(intake, kSecondsBehind, 2.0);

}  // namespace intake

/// OdometrySilence: when odometry stays away.
namespace silence {

/// [s] Least age at which odometry is missing; motion models carry it on for as long. A few cycles
/// of any base.
ORTUNG_CONSTANT(silence, kPatience, 0.3);
/// [s] Least time between two of them that is a silence, however rarely they come, and over which
/// a robot's motion is not known from them. Chosen by hand.
ORTUNG_CONSTANT(silence, kLongest, 2.0);
/// [s] Time in which a long one of these times is forgotten. By ds6, whose odometry comes 67 times
/// a second, and stops for 0.3 to 1 s once in three seconds.
ORTUNG_CONSTANT(silence, kForgotten, 60.0);

}  // namespace silence

/// FrozenDevices: readings that repeat themselves.
namespace frozen {

/// [share of min_distance_m] Way on which a device repeats few words before it counts as frozen.
/// Chosen by hand: several readings of a ring of sonars beside a wall.
ORTUNG_CONSTANT(frozen, kTimesFarther, 4.0);
/// Least number of different words in these readings. Chosen by hand: two sightings of landmarks.
ORTUNG_CONSTANT(frozen, kFewWords, 6);

}  // namespace frozen

/// NominalTime: how long weighing takes.
namespace nominal {

/// [ns] Time per pose of weighers that do not report their own. Chosen by hand: more than any
/// weigher of this project takes.
ORTUNG_CONSTANT(nominal, kOtherNanoseconds, 50.0);

}  // namespace nominal

/// UpdateTime: how much of an update's time is left.
namespace budget {

/// [share] Share of the budget for weighing and searches. Chosen by hand: the rest is for all other
/// work.
ORTUNG_CONSTANT(budget, kShare, 0.8);
/// [share] Share of the time before what must follow after which a clock ends the weighing of the
/// belief. Chosen by hand: what can wait gets the rest.
ORTUNG_CONSTANT(budget, kShareOfWeighing, 0.75);
/// [share] Greatest share of the same time that the weighing leaves to what has asked for it in the
/// last update. Chosen by hand: what the belief says comes first.
ORTUNG_CONSTANT(budget, kMostClaimed, 0.6);
/// [share] Share of the budget that is left for what is not measured. Chosen by hand.
ORTUNG_CONSTANT(budget, kMargin, 0.1);
/// [share] Greatest share of the budget that the belief's estimate may take, so that the rest is
/// for weighing. Chosen by hand.
ORTUNG_CONSTANT(budget, kMostToEstimate, 0.5);
/// [share] Share of the longest time of some work that is left when it is done again. Chosen by
/// hand: of a hundred updates one may be late.
ORTUNG_CONSTANT(budget, kTimeKept, 0.99);
/// Greatest ratio of the longest time of some work to the one before: a program that was stopped
/// for a while must not end all searches. Chosen by hand.
ORTUNG_CONSTANT(budget, kGrowth, 2.0);
/// Number of times that a step is refused in a row before it begins although it may be late. Chosen
/// by hand: of two hundred updates one may be late.
ORTUNG_CONSTANT(budget, kPatience, 200);
/// [ns] Nominal time to draw and anneal a pose, without weighing it. Cost.
ORTUNG_CONSTANT(budget, kPoseNanoseconds, 150.0);
/// [ns] Nominal time of all that follows the weighing of a sample. Cost.
ORTUNG_CONSTANT(budget, kSampleNanoseconds, 150.0);
/// Number of samples that would take as long as what does not depend on their number. Cost.
ORTUNG_CONSTANT(budget, kSamplesOfNone, 1000.0);
/// [share] Share of the budget that searches get at least, so that they end. Cost.
ORTUNG_CONSTANT(budget, kLeastShare, 0.1);

}  // namespace budget

}  // namespace ortung::tuning
