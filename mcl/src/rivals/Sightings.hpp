#pragma once

#include <optional>

#include "BeliefTuning.hpp"
#include "Lead.hpp"
#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"

namespace ortung {

/// Places that searches of the whole field have found, each one the only place that explains its
/// reading. If the second one is where odometry leads from the first one, both are right, however
/// badly their readings fit: a search that errs finds another wrong place with the next reading, or
/// the same one, because the crowd that misleads it comes along with the robot. Neither is where
/// odometry leads to, once the robot has moved. Not thread-safe.
class ORTUNG_API Sightings {
 public:
  /// Notes a place that was found alone.
  /// @param ratio ln p(reading | place) - ln p(reading | belief) [nats]
  /// @param odometry odometry's pose when the reading was taken; without it sightings can't be
  ///   compared, so that none counts with another
  /// @returns what this sighting and those before that agree with it say against the belief [nats]
  double see(const Pose2& place, double ratio, const std::optional<Pose2>& odometry);
  void forget() { last_.reset(); }

 private:
  struct Sighting {
    Pose2 place;
    Pose2 odometry;
  };
  std::optional<Sighting> last_;
  Lead lead_{tuning::lead::kMostNatsIfUnique};
};

}  // namespace ortung
