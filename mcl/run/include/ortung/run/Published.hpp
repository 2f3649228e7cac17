#pragma once

#include <span>

#include "ortung/base/Export.hpp"
#include "ortung/core/Message.hpp"
#include "ortung/mcl/PoseEstimate.hpp"
#include "ortung/mcl/SampleSet.hpp"

// What a localization tells, in the formats of the container (LocalizationConfig::publish).
namespace ortung {

/// mcl/LOCALIZATION/status, see TrackData.
ORTUNG_API Message trackMessage(const PoseEstimate& estimate);
/// mcl/LOCALIZATION/places, see ClustersData. @param places heaviest first
ORTUNG_API Message clustersMessage(Timestamp stamp, std::span<const PoseEstimate> places);
/// mcl/LOCALIZATION/samples, see SamplesData: of more than these can hold, evenly picked ones.
ORTUNG_API Message samplesMessage(Timestamp stamp, const SampleSet& samples);

}  // namespace ortung
