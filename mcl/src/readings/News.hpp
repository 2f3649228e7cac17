#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "ortung/base/Time.hpp"
#include "ortung/core/Weigher.hpp"
#include "ortung/mcl/SampleSet.hpp"

namespace ortung {

class SensorData;
class Workers;

/// A reading that is to be weighed: all that is needed of it once the container's lock is given
/// back.
struct News {
  const SensorData* feature;  ///< identity of the feature, which is not read any more
  std::uint64_t sequence;
  std::shared_ptr<const Weigher> weigher;
  /// Weigher without the correction; null: nothing was corrected.
  std::shared_ptr<const Weigher> asRead = {};
};

using NewsByTime = std::map<Timestamp, std::vector<News>>;

/// What the readings of one moment round poses to, at most.
PoseResolution coarsestOf(const std::vector<News>& news);
/// What it takes to ask all of them for a pose, about [ns].
double nanosecondsOf(const std::vector<News>& news);

/// ln p of the readings of one moment at each sample, finite whatever plugins answer.
/// @param out as many as samples
void weigh(const std::vector<News>& news, const SampleSet& set, Workers* workers,
           std::vector<float>& out);

}  // namespace ortung
