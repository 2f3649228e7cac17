#pragma once

#include <string>
#include <vector>

namespace ortung {

/// Robots that ship with the program, "robot NAME TEXT" each, in the order of their names: the file
/// without its ending, and what its first line says of it.
std::vector<std::string> shippedRobots();

}  // namespace ortung
