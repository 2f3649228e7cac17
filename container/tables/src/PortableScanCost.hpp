#pragma once

#include "ScanCost.hpp"

namespace ortung {

/// The ScanCostKernel of every machine.
void portableScanCost(const ScanReading& reading, std::span<const std::uint8_t* const> rows,
                      std::uint32_t* costs);

}  // namespace ortung
