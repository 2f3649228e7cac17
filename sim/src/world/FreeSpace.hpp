#pragma once

#include <cstdint>
#include <vector>

#include "WorldModel.hpp"
#include "ortung/tables/FieldRegion.hpp"

namespace ortung {

/// The free space among all fixed bodies. As in the physics, bodies collide where their ranges of
/// height overlap. Thread-safe.
class FreeSpace {
 public:
  /// @param world borrowed
  explicit FreeSpace(const WorldModel& world);

  /// Returns whether a cylinder touches nothing solid, lies in the field, and has its centre in
  /// known space.
  bool isFree(double x, double y, const RobotSize& size) const;
  /// Returns the cells with room for a robot, see SimWorld::region().
  FieldRegion region(double cell, const RobotSize& robot) const;

 private:
  struct Grid {
    const GridBody* body;
    Box2 bounds;  ///< box in the field around the map
    /// Distance to the nearest occupied cell, centre to centre [cells].
    std::vector<float> toOccupied;
  };
  // Places of the map that lies straight.
  static bool isKnown(const Grid& grid, double x, double y);
  static bool touches(const Grid& grid, double x, double y, double radius);
  bool isFreeOfGrids(double x, double y, const RobotSize& size) const;
  bool isInField(double x, double y, double radius) const;
  void block(const FieldGrid& grid, const RobotSize& size, std::vector<std::uint8_t>& mask) const;

  Box2 whole_;                ///< bounds of the field
  std::vector<Box2> bounds_;  ///< of the field, or of each floor of a building
  std::vector<const Primitive*> bodies_;
  std::vector<Grid> grids_;
};

}  // namespace ortung
