#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/core/SensorData.hpp"
#include "ortung/core/Weigher.hpp"
#include "ortung/tables/FieldRegion.hpp"

/// Maps of what features expect, and of how probable their readings are, over the whole field
/// (paper, Fig. 7). Maps have one value per cell of the region's grid, at its centre; NaN where a
/// cell is not open. Thread-safe. A function that takes features needs the container's read lock if
/// others set readings; weighers need none.
namespace ortung {

/// The expectations of one feature over the field (Fig. 7a).
struct ExpectationMap {
  /// Values [m] or [rad] by the feature's format; NaN: nothing expected.
  std::vector<double> values;
  std::size_t count = 0;  ///< most values that the feature expects at a pose
};

/// Computes the map of one value. @param index which of the feature's values, e.g. the beam of a
/// scan; at `count` or above, all
///   values of the map are NaN
/// @param heading of the robot [rad]
ORTUNG_API ExpectationMap expectationMap(const FieldRegion& region, const SensorData& feature,
                                         std::size_t index, double heading);

/// Returns headings of a whole turn [rad], as close as the tables of @p features can distinguish.
/// @param headingStep of the tables (TableInfo) [rad]
ORTUNG_API std::vector<double> mapHeadings(double headingStep,
                                           std::span<const SensorData* const> features);

/// Returns the same field in square cells that are a whole number of its own wide, so that there
/// are
/// @p most at most, if that is at least 1; one is open where its centre is.
ORTUNG_API FieldRegion coarsened(const FieldRegion& region, std::size_t most);

/// Weighers of the present readings of features; readings that say nothing about poses have none.
using Weighers = std::vector<std::shared_ptr<const Weigher>>;
ORTUNG_API Weighers weighersOf(std::span<const SensorData* const> features);

/// Returns the product of p(s|l) of some readings (Fig. 7b), in [0, 1]: the best of @p headings for
/// each cell. Without weighers all is 1.
/// @param readings taken under the container's lock, which need not be held any more
/// @param headings of the robot [rad]
/// @param goOn called with the share done whenever a few cells were weighed at a heading, so often
///   enough for a caller that has to give way; false: stops with an empty map
ORTUNG_API std::vector<double> probabilityMap(const FieldRegion& region, const Weighers& readings,
                                              std::span<const double> headings,
                                              const std::function<bool(double)>& goOn = {});
/// Returns the same as ln p, where p would be too small for a double.
ORTUNG_API std::vector<double> logProbabilityMap(const FieldRegion& region,
                                                 const Weighers& readings,
                                                 std::span<const double> headings,
                                                 const std::function<bool(double)>& goOn = {});

}  // namespace ortung
