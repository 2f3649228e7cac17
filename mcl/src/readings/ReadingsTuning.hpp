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
