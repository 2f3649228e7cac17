#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/core/SensorContainer.hpp"
#include "ortung/core/Source.hpp"
#include "ortung/study/Fault.hpp"

namespace ortung {

/// Returns a source of the readings of @p source with faults. Ground truth is never altered, and
/// neither is anything outside of a fault's time. Several faults of one feature are applied one
/// after the other. The same seed gives the same readings. remark() also names faults that met no
/// reading.
/// @param robot its features' formats say what readings consist of; it must live as long as the
///   source that is returned
/// @throws FaultError for a feature that the robot lacks, or a fault that its format can't have
ORTUNG_API std::unique_ptr<Source> disturbed(std::unique_ptr<Source> source,
                                             const std::vector<Fault>& faults,
                                             const SensorContainer& robot, std::uint64_t seed);

}  // namespace ortung
