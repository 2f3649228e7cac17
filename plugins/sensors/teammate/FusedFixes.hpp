#pragma once

#include <span>
#include <vector>

#include "ortung/formats/PoseFixData.hpp"

namespace ortung {

/// What several who looked say together: fixes that agree within their errors become one, by the
/// product of their normal distributions; those that do not stay beside each other, the surest
/// first.
/// @param added what of its error each keeps to itself, see PoseFixData::Config
std::vector<PoseFixData::Fix> fused(std::span<const PoseFixData::Fix> fixes,
                                    const PoseFixData::Config& added);

}  // namespace ortung
