#pragma once

#include <optional>
#include <string>
#include <vector>

#include "BoardReplies.hpp"
#include "ortung/ros2/Messages.hpp"

namespace ortung::foxglove {

/// Makes a map of a field that is occupied at its walls and free elsewhere; nothing if the board
/// has no bounds or no walls.
/// @param world first line of `DESCRIBE world`
/// @param lines lines of `DESCRIBE field`
std::optional<ros2::OccupancyGrid> mapOfField(const BoardReply& world,
                                              const std::vector<std::string>& lines);

}  // namespace ortung::foxglove
