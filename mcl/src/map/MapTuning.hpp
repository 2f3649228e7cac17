#pragma once

#include "Constant.hpp"

/// Constants of the folder map: where the map no longer fits. Each comment says what the constant
/// is, its unit, and where its value comes from.
namespace ortung::tuning {

/// MapWatch: cells that beams contradict.
namespace map {

/// [sigma] Errors of noise and of the pose that contradict nothing.
ORTUNG_CONSTANT(map, kSigmas, 3.0);
/// Greatest number of points of which a cell's middle is the mean: later ones count as much as
/// these, in case the wall was moved a little.
ORTUNG_CONSTANT(map, kMostPoints, 50.0);
/// [m] Standard deviation of positions up to which an estimate says where beams end. Half a cell.
ORTUNG_CONSTANT(map, kMostSigma, 0.05);
/// [rad] Standard deviation of headings up to which it does: 0.1 m at 6 m.
ORTUNG_CONSTANT(map, kMostTurn, 0.0175);
/// [share] Share of beams above which it is the place that is doubtful, rather than the map.
ORTUNG_CONSTANT(map, kMostOdd, 0.5);
/// [m] Least distance between a range and what was expected that contradicts the map, beside three
/// sigmas: surfaces of maps made of cells are that far off at corners.
ORTUNG_CONSTANT(map, kMargin, 0.15);
/// [rad] Beams around one whose expectations it may have, too, beside three sigmas of the pose: at
/// edges a small error of the pose changes the range by metres.
ORTUNG_CONSTANT(map, kAround, 0.0131);
/// Least number of scans in a pass that say something: one or two may be a person who stands.
ORTUNG_CONSTANT(map, kLooks, 3);
/// [m] Greatest distance between two beams that go on behind something, which is gone then: three
/// cells.
ORTUNG_CONSTANT(map, kBeside, 0.3);
/// [share] Share of a pass's looks that has to agree.
ORTUNG_CONSTANT(map, kAgree, 0.75);
/// [s] Time out of sight after which a pass is over.
ORTUNG_CONSTANT(map, kGap, 10.0);
/// [s] Time after which another pass begins at any rate, e.g. in a hall where all is in sight.
ORTUNG_CONSTANT(map, kLongest, 60.0);
/// Passes in a row that make a cell sure. People and doors seldom stay that long.
ORTUNG_CONSTANT(map, kPasses, 2);
/// Least number of sure cells next to each other: 0.4 m of wall.
ORTUNG_CONSTANT(map, kTogether, 4);
/// [m] Least way between two looks, else they would not be independent. A cell.
ORTUNG_CONSTANT(map, kStep, 0.1);
/// [rad] Least turn between two looks.
ORTUNG_CONSTANT(map, kStepTurn, 0.0873);

}  // namespace map

}  // namespace ortung::tuning
