#include "ortung/run/Published.hpp"

#include <algorithm>
#include <cmath>

#include "ortung/formats/ClustersData.hpp"
#include "ortung/formats/PoseData.hpp"
#include "ortung/formats/ProtectionData.hpp"
#include "ortung/formats/SamplesData.hpp"
#include "ortung/formats/TrackData.hpp"

namespace ortung {
namespace {

/// Returns the greatest log weight, to which others are compared; 0 if all samples have weight 0.
float heaviest(const SampleSet& samples) {
  const auto best = std::max_element(samples.logWeight.begin(), samples.logWeight.end());
  return best == samples.logWeight.end() || !std::isfinite(*best) ? 0.0F : *best;
}

}  // namespace

Message trackMessage(const PoseEstimate& estimate) {
  return TrackData::message(estimate.stamp,
                            {estimate.status, estimate.reason, estimate.quality, estimate.share,
                             estimate.relocalizations, estimate.relocalization});
}

Message smoothMessage(const PoseEstimate& estimate) {
  return {estimate.stamp, kSmoothId, PoseData::encode(estimate.smooth)};
}

Message protectionMessage(const PoseEstimate& estimate) {
  return ProtectionData::message(estimate.stamp,
                                 {estimate.protection.metres, estimate.protection.radians});
}

Message clustersMessage(Timestamp stamp, std::span<const PoseEstimate> places) {
  ClustersData::Reading reading;
  for (const PoseEstimate& place : places)
    reading.push_back({place.share, {place.pose, place.covariance}});
  return ClustersData::message(stamp, reading);
}

ChangesData::Reading toldOf(const MapChanges& changes) {
  ChangesData::Reading reading{MapChanges::kCell, {}};
  for (const MapChange& one : changes.cells)
    reading.cells.push_back(
        {one.kind == MapChange::Kind::kNew, one.isSure, one.x, one.y, one.passes, one.against});
  return reading;
}

Message changesMessage(Timestamp stamp, const MapChanges& changes) {
  return ChangesData::message(stamp, toldOf(changes));
}

Message samplesMessage(Timestamp stamp, const SampleSet& samples) {
  const std::size_t count = std::min(samples.size(), SamplesData::kMostSamples);
  const float best = heaviest(samples);
  SamplesData::Reading reading;
  reading.reserve(count);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = k * samples.size() / count;
    reading.push_back({{static_cast<double>(samples.x[i]), static_cast<double>(samples.y[i]),
                        static_cast<double>(samples.theta[i])},
                       std::exp(static_cast<double>(samples.logWeight[i] - best))});
  }
  return SamplesData::message(stamp, reading);
}

}  // namespace ortung
