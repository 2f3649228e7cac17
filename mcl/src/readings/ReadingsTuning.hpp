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
/// [share] Share of the budget that searches get at least, so that they end. Cost.
ORTUNG_CONSTANT(budget, kLeastShare, 0.1);

}  // namespace budget

}  // namespace ortung::tuning
