#pragma once

#include <cstdint>
#include <vector>

#include "WorldModel.hpp"
#include "ortung/tables/FieldRegion.hpp"

namespace ortung {

/// Where there is room among everything that does not move. As for the physics, bodies meet where
/// their ranges of height overlap. Thread-safe.
class FreeSpace {
 public:
  /// @param world borrowed
  explicit FreeSpace(const WorldModel& world);

  /// Whether a cylinder touches nothing solid, lies in the field, and has its centre in known
  /// space.
  bool isFree(double x, double y, const RobotSize& size) const;
  /// Cells with room for a robot, as SimWorld::region() gives them.
  FieldRegion region(double cell, const RobotSize& robot) const;

 private:
  struct Grid {
    const GridBody* body;
    std::vector<float> toOccupied;  ///< [cells], centre to centre
  };
  static bool isKnown(const Grid& grid, double x, double y);
  static bool touches(const Grid& grid, double x, double y, double radius);
  bool isFreeOfGrids(double x, double y, const RobotSize& size) const;
  bool isInField(double x, double y, double radius) const;
  void block(const FieldGrid& grid, const RobotSize& size, std::vector<std::uint8_t>& mask) const;

  Box2 bounds_;
  std::vector<const Primitive*> bodies_;
  std::vector<Grid> grids_;
};

}  // namespace ortung
