#pragma once

#include <cstddef>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/mcl/SampleSet.hpp"
#include "ortung/tables/Building.hpp"

namespace ortung {

/// Returns how much of the samples' weight is on each floor, in [0, 1], of sum 1; all 0 without
/// samples. @pre the building has floors
ORTUNG_API std::vector<double> floorShares(const Building& building, const SampleSet& samples);

/// Returns shares of floors by two sources, of sum 1: each other floor has the greater one of its
/// shares, and the estimate's floor the rest.
/// @param here index of the estimate's floor
/// @pre both have the same size, and a sum of 1
ORTUNG_API std::vector<double> greaterBeside(std::size_t here, const std::vector<double>& a,
                                             const std::vector<double>& b);

}  // namespace ortung
