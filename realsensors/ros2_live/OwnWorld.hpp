#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "ortung/ros2/Messages.hpp"
#include "ortung/tables/Building.hpp"

namespace ortung::ros2 {

/// A world file that a node has itself, in place of a map that is told, and the map files in it.
struct OwnWorld {
  struct Map {
    std::string floor;           ///< name of the floor that it is of; "": the world has no floors
    std::filesystem::path file;  ///< map file; "": the floor is made of something else
  };
  std::filesystem::path file;  ///< the world file (TOML)
  std::vector<Map> maps;       ///< one a floor; one of a world without floors

  /// Returns the map of a floor, of the first one if there is no such floor; null: it has no file.
  const Map* mapOf(const std::string& floor) const;
  /// Returns what a name of a floor or the path of a map file means; null: nothing here.
  const Map* find(const std::string& nameOrPath) const;
  /// Checks that tables are of a world with these floors.
  /// @throws std::runtime_error naming the floors of both
  void checkFloors(const Building& learned) const;
};

/// Finds the maps of a world file: those of its floors or, without floors, its only [[grid]].
/// @throws ConfigError if it is no TOML or names no map where a map has to be named
OwnWorld readOwnWorld(const std::filesystem::path& file);

/// Reads a map file, of any kind that worlds may have, as map_server publishes it: 0 free, 100
/// occupied, -1 unknown.
/// @param frame of the map @param stamp when it is loaded [ns]
/// @throws std::runtime_error whose message begins with the name of the file that is wrong
OccupancyGrid readOccupancyGrid(const std::filesystem::path& map, const std::string& frame,
                                std::int64_t stamp);

}  // namespace ortung::ros2
