#include "OdometrySilence.hpp"

#include <algorithm>
#include <cmath>

#include "BeliefTuning.hpp"
#include "ReadingsTuning.hpp"

namespace ortung {

using namespace tuning::silence;

void OdometrySilence::hear(const std::optional<Timestamp>& newest) {
  if (!newest) return forget();
  if (newest_ && *newest > *newest_) {
    const double gap = toSeconds(*newest - *newest_);
    if (gap > patience()) ended_ = {*newest_, *newest};
    usual_ *= std::exp(-gap / kForgotten);
    // The end of a long silence says nothing about what is usual.
    if (gap < kLongest) usual_ = std::max(gap, usual_);
  }
  newest_ = newest;
}

double OdometrySilence::patience() const {
  return std::max(kPatience, tuning::common::kLongGap * usual_);
}

std::optional<Timestamp> OdometrySilence::since(Timestamp stamp) const {
  if (!newest_) return std::nullopt;
  return toSeconds(stamp - *newest_) > patience() ? newest_ : std::nullopt;
}

bool OdometrySilence::isBridged(Timestamp stamp) const {
  return ended_ && stamp >= ended_->first && stamp <= ended_->second &&
         toSeconds(ended_->second - ended_->first) < kLongest;
}

}  // namespace ortung
