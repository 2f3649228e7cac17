#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "IsOver.hpp"
#include "ortung/base/Export.hpp"
#include "ortung/base/Time.hpp"
#include "ortung/core/Weigher.hpp"
#include "ortung/mcl/SampleSet.hpp"

namespace ortung {

class SensorData;
class Workers;

/// A new reading that is to be weighed: all that is needed of it once the container's lock is
/// released.
struct NewReading {
  const SensorData* feature;  ///< identity of the feature; its data is not read any more
  std::uint64_t sequence;
  std::shared_ptr<const Weigher> weigher;
  /// Weigher of the reading without bias correction; null: nothing was corrected.
  std::shared_ptr<const Weigher> asRead = {};
};

using ReadingsByTime = std::map<Timestamp, std::vector<NewReading>>;

/// Returns the coarsest resolution to which the readings of one time step round poses.
PoseResolution coarsestOf(const std::vector<NewReading>& news);
/// Returns the approximate time to weigh one pose by all of them [ns].
double nanosecondsOf(const std::vector<NewReading>& news);

/// Computes ln p of the readings of one time step at each sample. It is finite whatever plugins
/// return.
/// @param out ln p of each sample; resized to the size of @p set
void weigh(const std::vector<NewReading>& news, const SampleSet& set, Workers* workers,
           std::vector<float>& out);

/// Parts of a set, each of samples that are evenly spread over it, so each represents the whole.
struct Parts {
  std::size_t all = 1;
  std::size_t weighed = 1;  ///< the first of them
  bool has(std::size_t sample) const { return sample % all < weighed; }
};
/// Does the same part by part, until the time is over; at least the first.
/// @param atOnce parts that are weighed between two looks at the time
/// @param out what was not weighed is arbitrary
ORTUNG_API Parts weighUntil(const IsOver& isOver, const std::vector<NewReading>& news,
                            const SampleSet& set, Workers& workers, std::size_t atOnce,
                            std::vector<float>& out);

}  // namespace ortung
