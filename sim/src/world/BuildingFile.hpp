#pragma once

#include <optional>
#include <vector>

#include "WorldModel.hpp"
#include "ortung/base/Parameters.hpp"

namespace ortung {

/// The tables [[floor]] and [[lift]] of a world file, and what stands on which floor.
class BuildingFile {
 public:
  /// @param toml the file, borrowed @throws ConfigError
  explicit BuildingFile(const Parameters& toml);

  /// Returns the model of the floor that a table names by `floor`, in the floor's own frame; in a
  /// world without floors that of the whole world. @throws ConfigError
  WorldModel& floorOf(const Parameters& table);
  /// Returns the model of a table [[floor]] itself.
  WorldModel& floor(std::size_t index) { return floors_[index]; }
  /// Returns the tables [[floor]].
  const std::vector<Parameters>& tables() const { return tables_; }

  /// Puts all floors side by side into a world, farther apart than samples stray, and the lifts
  /// where they stop. @throws ConfigError for a floor without anything
  void moveInto(WorldModel& world);

 private:
  std::size_t indexOf(const Parameters& table) const;
  void readLifts(Building& building, const std::vector<Box2>& bounds) const;

  const Parameters& toml_;
  std::vector<Parameters> tables_;
  std::vector<std::string> names_;
  std::vector<WorldModel> floors_;  ///< one for a world without floors
};

/// Returns the box around all that stays where it is; around what moves, as it stands at the
/// beginning, where nothing else is; nothing for an empty world.
std::optional<Box2> extentOf(const WorldModel& world);

}  // namespace ortung
