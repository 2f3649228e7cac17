#include "OdometrySilence.hpp"

#include <algorithm>

#include "BeliefTuning.hpp"
#include "ReadingsTuning.hpp"

namespace ortung {

using namespace tuning::silence;

void OdometrySilence::hear(const std::optional<Timestamp>& newest) {
  if (!newest) return forget();
  if (newest_ && *newest > *newest_) {
    const double gap = toSeconds(*newest - *newest_);
    // The end of a silence says nothing about what is usual.
    if (gap < kLongest) usual_ = std::max(gap, tuning::common::kUsualKept * usual_);
  }
  newest_ = newest;
}

std::optional<Timestamp> OdometrySilence::since(Timestamp stamp) const {
  if (!newest_) return std::nullopt;
  const double patience = std::max(kPatience, tuning::common::kLongGap * usual_);
  return toSeconds(stamp - *newest_) > patience ? newest_ : std::nullopt;
}

}  // namespace ortung
