#pragma once

#include <optional>
#include <string>
#include <vector>

#include "BoardReplies.hpp"
#include "ortung/ros2/Messages.hpp"

namespace ortung::foxglove {

struct FieldMapOptions {
  /// That it may have; cells are as large as that needs, at least 0.05 m. By default few, since
  /// each client has a map.
  std::size_t mostCells = std::size_t{1} << 17;
  /// Only what is at this height [m]; nothing: all.
  std::optional<double> height = {};
  /// Whether occupied cells lie behind surfaces, as those of a map that a scanner has made, not on
  /// them.
  bool isBehindSurfaces = false;
};

/// Makes a map of a field that is occupied at the surfaces of walls and solids and free elsewhere;
/// nothing if the board has no bounds or no walls.
/// @param world first line of `DESCRIBE world`
/// @param lines lines of `DESCRIBE field`
std::optional<ros2::OccupancyGrid> mapOfField(const BoardReply& world,
                                              const std::vector<std::string>& lines,
                                              const FieldMapOptions& options = {});

}  // namespace ortung::foxglove
