#pragma once

#include "Constant.hpp"

/// Constants of the room readings: what is news, and what an update may cost.
/// What each one is, its unit, and where its value comes from; docs/constants.md has what half of
/// it and twice as much change on recordings.
namespace ortung::tuning {

/// Intake: what is news.
namespace intake {

/// [s] Jump of the stamps back after which a clock was set, or a log begins anew. Longer than any
/// delay of a device.
ORTUNG_CONSTANT(intake, kTimeJump, 5.0);
/// Looks in a row in which one feature is ahead of all that come: then its clock was set. By hand.
ORTUNG_CONSTANT(intake, kLooksBehind, 10);
/// [s] Least time over which these readings are spread. By hand.
ORTUNG_CONSTANT(intake, kSecondsBehind, 2.0);

}  // namespace intake

/// NominalTime: what weighing takes.
namespace nominal {

/// [ns] Time per pose of weighers that do not report their own. By hand: more than any of ours
/// takes.
ORTUNG_CONSTANT(nominal, kOtherNanoseconds, 50.0);

}  // namespace nominal

/// UpdateTime: how much of an update is left.
namespace budget {

/// [share] Share of the budget for weighing. By hand: the rest is for what is not weighing.
ORTUNG_CONSTANT(budget, kShare, 0.8);
/// [share] Least share of the budget for searches, so that they end. Cost.
ORTUNG_CONSTANT(budget, kLeastShare, 0.1);

}  // namespace budget

}  // namespace ortung::tuning
