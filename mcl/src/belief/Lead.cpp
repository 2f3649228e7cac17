#include "Lead.hpp"

#include <algorithm>

namespace ortung {
namespace {

constexpr double kEnoughNats = 16.0;  ///< lead that is enough to leave a place [nats]
constexpr double kHopelessNats = -12.0;

}  // namespace

void Lead::count(double ratio, double part) {
  nats_ += std::min(1.0, part) * std::clamp(ratio, -kMostNatsOfAReading, kMostNatsOfAReading);
}

void Lead::atLeast(double nats) { nats_ = std::max(nats, nats_); }

bool Lead::isEnough() const { return nats_ >= kEnoughNats; }

bool Lead::isHopeless() const { return nats_ <= kHopelessNats; }

}  // namespace ortung
