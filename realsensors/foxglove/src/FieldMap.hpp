#pragma once

#include <optional>
#include <string>
#include <vector>

#include "BoardReplies.hpp"
#include "ortung/ros2/Messages.hpp"

namespace ortung::foxglove {

/// A map with the walls of a field, which is free elsewhere; nothing if the board knows no bounds
/// or no walls.
/// @param world first line of `DESCRIBE world` @param lines of `DESCRIBE field`
std::optional<ros2::OccupancyGrid> mapOfField(const BoardReply& world,
                                              const std::vector<std::string>& lines);

}  // namespace ortung::foxglove
