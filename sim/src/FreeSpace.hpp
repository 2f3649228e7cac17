#pragma once

#include <cstdint>
#include <vector>

#include "WorldModel.hpp"
#include "ortung/container/FieldRegion.hpp"

namespace ortung {

/// Where points and circles are free of everything that does not move. Thread-safe.
class FreeSpace {
 public:
  /// @param world must outlive this
  explicit FreeSpace(const WorldModel& world);

  /// Whether a circle touches nothing solid, lies in the field, and has its centre in known space.
  bool isFree(double x, double y, double radius) const;
  /// As SimWorld::region().
  FieldRegion region(double cell, double robotRadius) const;

 private:
  struct Grid {
    const GridMap* map;
    std::vector<float> toOccupied;  ///< [cells], centre to centre
  };
  static bool isKnown(const Grid& grid, double x, double y);
  static bool touches(const Grid& grid, double x, double y, double radius);
  bool isFreeOfGrids(double x, double y, double radius) const;
  bool isInField(double x, double y, double radius) const;
  void block(const FieldGrid& grid, double radius, std::vector<std::uint8_t>& mask) const;

  Box2 bounds_;
  std::vector<const Primitive*> bodies_;
  std::vector<Grid> grids_;
};

}  // namespace ortung
