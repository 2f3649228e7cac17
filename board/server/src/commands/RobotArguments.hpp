#pragma once

#include <cstdint>

#include "Caller.hpp"
#include "Request.hpp"

namespace ortung::server {

constexpr std::int64_t kLastRobot = 0xFFFFFFFF;

/// robot=N, or the client's first; the only one of a live world.
/// @param orWorld whether robot 0, the world itself, will do, too
RobotId takeRobot(Caller& caller, Request& request, bool orWorld = false);

/// Which readings, and how.
/// @param again also those that the client has got already
Choice takeChoice(Caller& caller, Request& request, bool again);

}  // namespace ortung::server
