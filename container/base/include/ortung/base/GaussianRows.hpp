#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "ortung/base/Export.hpp"

namespace ortung {

/// Fills four rows with the Gaussian numbers of fillGaussian(), one column of four for each thing
/// that needs as many: rows[k][i] is number 4 (first + i) + k of the stream. Loops over the columns
/// vectorize, while numbers in one row have to be sorted first.
/// @pre the rows have the same size
ORTUNG_API void fillGaussianRows(std::uint64_t seed, std::uint64_t stream, std::uint64_t first,
                                 const std::array<std::span<float>, 4>& rows);

}  // namespace ortung
