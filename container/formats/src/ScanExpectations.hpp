#pragma once

#include <memory>
#include <string>

#include "Expectations.hpp"
#include "ortung/formats/ScanData.hpp"

namespace ortung {

/// Makes the expectations of a scan for its perception.
std::unique_ptr<Expectations> expectationsOf(const ScanData& scan, const ScanData::Config& config);
std::unique_ptr<Expectations> expectedRays(const ScanData& scan, const ScanData::Config& config);
std::unique_ptr<Expectations> expectedEndPoints(const ScanData& scan,
                                                const ScanData::Config& config);

// --- what both of them need ---

/// Distance between positions from which surfaces are marked [cells of the surfaces]: that is
/// enough for beams of many positions to meet in each cell.
inline constexpr double kCellsApart = 6.0;

/// Returns the margin of a field of end points beyond the region's bounds [m].
inline double marginOf(const ScanData::Config& config) { return 2 * config.endPointCell; }

/// Returns the learning key but for what one perception alone depends on.
std::string scanKey(const ScanData& scan, const std::string& perception);

/// Returns the number of headings whose scans together span a turn.
int fewestViews(const ScanData::Config& config);

}  // namespace ortung
