#include "ortung/core/RobotCommands.hpp"

namespace ortung {

RobotCommands::~RobotCommands() = default;

}  // namespace ortung
