#pragma once

#include <string>

#include "RobotReadings.hpp"

namespace ortung::server {

class Caller;

/// Sends a client those readings of a robot that it chose and did not get before, or all of them.
/// @param tag "*": nobody asked for it
/// @param command whose reply it is
void sendReadings(Caller& caller, const std::string& tag, const char* command, RobotId robot,
                  const Choice& choice);

}  // namespace ortung::server
