#pragma once

#include <string>

#include "ortung/run/Robot.hpp"

namespace ortung::app {

/// Returns lines about a robot's sensors, as people ask for them: where each one sits, how often it
/// reads, and which of its features localize.
std::string describeSensors(const Robot& robot);

}  // namespace ortung::app
