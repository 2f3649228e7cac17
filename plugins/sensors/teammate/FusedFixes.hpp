#pragma once

#include <span>
#include <vector>

#include "ortung/formats/PoseFixData.hpp"

namespace ortung {

/// Fuses the fixes of several observers: fixes that agree within their errors become one, by the
/// product of their normal distributions; others stay separate, the most certain first.
/// @param added further errors of each fix, see PoseFixData::Config
std::vector<PoseFixData::Fix> fused(std::span<const PoseFixData::Fix> fixes,
                                    const PoseFixData::Config& added);

}  // namespace ortung
