#pragma once

#include <vector>

#include "ortung/base/Time.hpp"

namespace ortung::app {

/// The longest time [s] between two moments of a series over which a line is drawn: five times the
/// usual step, at least 1 s. Over longer ones nothing is known, and lines break.
double longestDrawnStep(std::vector<Timestamp> stamps);

}  // namespace ortung::app
