#include "Sightings.hpp"

#include "Centre.hpp"
#include "RivalsTuning.hpp"

namespace ortung {

using namespace tuning;

double Sightings::see(const Pose2& place, double ratio, const std::optional<Pose2>& odometry) {
  if (!odometry) forget();
  if (last_) {
    const double travelled = apart(last_->odometry, *odometry);
    const Pose2 ledTo = last_->place * (inverse(last_->odometry) * *odometry);
    const double off = apart(ledTo, place);
    const bool isNear = off < common::kPlaceMetres;
    if (isNear && travelled < common::kIndependent) return lead_.nats();
    if (!isNear || off >= sightings::kAgrees * travelled) lead_.forget();
  } else {
    lead_.forget();
  }
  lead_.count(ratio, 1.0);
  if (odometry) last_ = Sighting{place, *odometry};
  return lead_.nats();
}

}  // namespace ortung
