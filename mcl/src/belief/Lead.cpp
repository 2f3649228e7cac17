#include "Lead.hpp"

#include <algorithm>
#include <cmath>

#include "BeliefTuning.hpp"

namespace ortung {

void Lead::count(double ratio, double part) {
  nats_ += std::min(1.0, part) * std::clamp(ratio, -most_, most_);
}

void Lead::atLeast(double nats) { nats_ = std::max(nats, nats_); }

void Lead::add(const Lead& before) { nats_ += std::max(0.0, before.nats_); }

bool Lead::isEnough() const { return nats_ >= tuning::lead::kEnoughNats; }

bool Lead::isHopeless() const { return nats_ <= tuning::lead::kHopelessNats; }

double mostNatsFor(int places) {
  return std::max(tuning::lead::kMostNatsOfAReading,
                  tuning::lead::kMostNatsIfUnique - std::log(places));
}

}  // namespace ortung
