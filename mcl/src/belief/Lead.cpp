#include "Lead.hpp"

#include <algorithm>

#include "BeliefTuning.hpp"

namespace ortung {

void Lead::count(double ratio, double part) {
  nats_ += std::min(1.0, part) *
           std::clamp(ratio, -tuning::lead::kMostNatsOfAReading, tuning::lead::kMostNatsOfAReading);
}

void Lead::atLeast(double nats) { nats_ = std::max(nats, nats_); }

bool Lead::isEnough() const { return nats_ >= tuning::lead::kEnoughNats; }

bool Lead::isHopeless() const { return nats_ <= tuning::lead::kHopelessNats; }

}  // namespace ortung
