#include "EstimateData.hpp"

#include <span>

namespace ortung {
namespace {

SensorId ownId() { return {"mcl", "LOCALIZATION", "pose"}; }

}  // namespace

EstimateData::EstimateData() : PoseFixData(ownId(), {}) {}
EstimateData::~EstimateData() = default;

Message EstimateData::message(const PoseEstimate& estimate) {
  const Fix fix{estimate.pose, estimate.covariance};
  return {estimate.stamp, ownId(), encode(std::span(&fix, 1))};
}

}  // namespace ortung
