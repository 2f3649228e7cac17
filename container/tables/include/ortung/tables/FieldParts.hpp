#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/tables/FieldRegion.hpp"

namespace ortung {

/// The parts of the floor that walls keep apart: closed rooms, what is outside. They are numbered
/// from 0. A door
/// that is too narrow for the robot, as far as cells tell, keeps nothing apart: maps of real
/// buildings have many that robots went through. Not thread-safe.
class ORTUNG_API FieldParts {
 public:
  struct Part {
    std::size_t cells = 0;  ///< number of cells in which the robot can stand
    /// Whether it reaches the edge of the grid: it may be the outside of walls.
    bool reachesEdge = false;
  };
  /// @param passable grid.size() entries, 0 or 1: cells with room for something small. Over their
  ///   edges one gets from one to the next, so it must not be so small that it slips through walls
  /// @throws std::invalid_argument for a mask of another size
  FieldParts(FieldRegion region, const std::vector<std::uint8_t>& passable);

  const std::vector<Part>& parts() const { return parts_; }
  /// Returns the part of the cell that holds the point [m], or nothing where there is no room.
  std::optional<std::size_t> partAt(double x, double y) const;
  /// Returns the part in which a robot most likely is: the largest one. With @p edgeIsOutside one
  /// that reaches the edge counts only if no enclosed one is a quarter as large: it is what walls
  /// leave over of their bounding box, e.g. beside a hall that is an L, and not a field without
  /// walls on which a hut stands. @pre there is a part
  std::size_t main(bool edgeIsOutside) const;
  /// Returns the region reduced to one part: a robot can stand nowhere else.
  FieldRegion only(std::size_t part) const;

 private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;
  FieldRegion region_;
  std::vector<std::uint32_t> partOf_;  ///< number of the part, by cell; kNone: no part
  std::vector<Part> parts_;
};

/// Returns whether a robot can stand anywhere within @p radius [m] of a point, as the centres of
/// cells say.
ORTUNG_API bool canStandNear(const FieldRegion& region, double x, double y, double radius);

}  // namespace ortung
