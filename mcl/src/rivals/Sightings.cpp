#include "Sightings.hpp"

#include <algorithm>
#include <cmath>

#include "RivalsTuning.hpp"

namespace ortung {
namespace {

using namespace tuning;

/// Returns metres and radians together.
double extent(const Pose2& change) {
  return std::hypot(change.x, change.y) + std::abs(change.theta);
}

}  // namespace

double Sightings::see(const Pose2& place, double ratio, const std::optional<Pose2>& odometry) {
  if (!odometry) forget();
  if (last_) {
    const Pose2 change = inverse(last_->odometry) * *odometry;
    const double travelled = extent(change);
    const double off = extent(inverse(last_->place * change) * place);
    const bool isSame = off < common::kPlaceMetres;
    if (isSame && travelled < common::kIndependent) return lead_.nats();
    if (!isSame || off >= sightings::kAgrees * travelled) lead_.forget();
  } else {
    lead_.forget();
  }
  lead_.count(ratio, 1.0);
  if (odometry) last_ = Sighting{place, *odometry};
  return lead_.nats();
}

}  // namespace ortung
