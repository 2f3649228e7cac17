#include "LiftRides.hpp"

#include <cmath>
#include <cstddef>
#include <vector>

#include "MotionTuning.hpp"

namespace ortung {

std::optional<LiftRides::Stop> LiftRides::stopAt(double x, double y) const {
  for (const Lift& lift : region_.building.lifts)
    for (const LiftStop& stop : lift.stops)
      if (std::hypot(x - stop.pose.x, y - stop.pose.y) <= lift.radius) return Stop{&lift, &stop};
  return std::nullopt;
}

bool LiftRides::isInLift(double x, double y) const {
  return region_.building.lifts.empty() || stopAt(x, y).has_value();
}

/// Returns where a pose may be after a ride; nothing: where it is.
std::optional<Pose2> LiftRides::randomStop(const Pose2& pose, Random& random) const {
  const Building& building = region_.building;
  if (building.lifts.empty()) {
    const Floor& from = building.floorOf(pose.x);
    const Floor& to =
        building.floors[static_cast<std::size_t>(random.below(building.floors.size()))];
    const Pose2 there = to.toField(from.fromField(pose));
    const std::ptrdiff_t cell = region_.grid.cellAt(there.x, there.y);
    const bool hasRoom = cell >= 0 && region_.standable[static_cast<std::size_t>(cell)] != 0;
    return &from != &to && hasRoom ? std::optional(there) : std::nullopt;
  }
  const std::optional<Stop> from = stopAt(pose.x, pose.y);
  if (!from) return std::nullopt;
  const std::vector<LiftStop>& stops = from->lift->stops;
  const LiftStop& to = stops[static_cast<std::size_t>(random.below(stops.size()))];
  if (&to == from->stop) return std::nullopt;
  return to.pose * (inverse(from->stop->pose) * pose);
}

bool LiftRides::ride(const MovableSamples& samples, double seconds, Random random) const {
  const double share = 1.0 - std::exp(-seconds / tuning::lifts::kSeconds);
  bool isAny = false;
  for (std::size_t i = 0; i < samples.x.size(); ++i) {
    if (random.uniform() >= share) continue;
    const std::optional<Pose2> there =
        randomStop({static_cast<double>(samples.x[i]), static_cast<double>(samples.y[i]),
                    static_cast<double>(samples.theta[i])},
                   random);
    if (!there) continue;
    samples.x[i] = static_cast<float>(there->x);
    samples.y[i] = static_cast<float>(there->y);
    samples.theta[i] = static_cast<float>(there->theta);
    isAny = true;
  }
  return isAny;
}

}  // namespace ortung
