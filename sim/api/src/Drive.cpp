#include "ortung/sim_api/Drive.hpp"

namespace ortung {

Drive::~Drive() = default;

Twist Drive::measuredVelocity(bool) const { return velocity(); }

std::span<const std::uint32_t> Drive::motionData() const { return {}; }

std::string Drive::motionDataHelp() const { return "no motion data"; }

}  // namespace ortung
