#pragma once

#include <span>

#include "ortung/base/Export.hpp"
#include "ortung/core/Message.hpp"
#include "ortung/formats/ChangesData.hpp"
#include "ortung/mcl/MapChanges.hpp"
#include "ortung/mcl/PoseEstimate.hpp"
#include "ortung/mcl/SampleSet.hpp"

// What a localization publishes, in the formats of the container (LocalizationConfig::publish).
namespace ortung {

/// The feature of the smooth pose, in the format of PoseData.
inline const SensorId kSmoothId{"mcl", "LOCALIZATION", "smooth"};

/// Makes the reading of mcl/LOCALIZATION/smooth, see PoseEstimate::smooth.
ORTUNG_API Message smoothMessage(const PoseEstimate& estimate);
/// Makes the reading of mcl/LOCALIZATION/status, see TrackData.
ORTUNG_API Message trackMessage(const PoseEstimate& estimate);
/// Makes the reading of mcl/LOCALIZATION/protection, see ProtectionData.
ORTUNG_API Message protectionMessage(const PoseEstimate& estimate);
/// Makes the reading of mcl/LOCALIZATION/places, see ClustersData. @param places heaviest first
ORTUNG_API Message clustersMessage(Timestamp stamp, std::span<const PoseEstimate> places);
/// Returns changes of a map as ChangesData has them.
ORTUNG_API ChangesData::Reading toldOf(const MapChanges& changes);
/// Makes the reading of mcl/LOCALIZATION/map, see ChangesData.
ORTUNG_API Message changesMessage(Timestamp stamp, const MapChanges& changes);
/// Makes the reading of mcl/LOCALIZATION/samples, see SamplesData; if there are more samples than
/// it can hold, they are picked evenly.
ORTUNG_API Message samplesMessage(Timestamp stamp, const SampleSet& samples);

}  // namespace ortung
