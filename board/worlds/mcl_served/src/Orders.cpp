#include "Orders.hpp"

#include <array>

#include "ortung/formats/TrackData.hpp"

namespace ortung {

SensorId samplesId() { return {"mcl", "LOCALIZATION", "samples"}; }

LocalizationState stateOf(Localization& localization) {
  using Kind = LocalizationState::Kind;
  const auto track = localization.container().get<TrackData>({"mcl", "LOCALIZATION", "status"});
  if (!track || track->reason == TrackReason::kSearching) return {Kind::kSearching, 1.0};
  return {Kind::kRunning, 1.0, std::string(nameOf(track->status)) + ": " + nameOf(track->reason)};
}

void obey(const LocalizationOrder& order, Localization& localization) {
  using Kind = LocalizationOrder::Kind;
  const double place = order.sigmaPosition * order.sigmaPosition;
  const double heading = order.sigmaHeading * order.sigmaHeading;
  if (order.kind == Kind::kPlace)
    localization.setPose(order.pose, {place, 0, 0, 0, place, 0, 0, 0, heading});
  if (order.kind == Kind::kAnywhere) localization.relocalize();
}

}  // namespace ortung
