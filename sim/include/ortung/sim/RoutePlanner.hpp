#pragma once

#include <cstdint>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/sim/SimWorld.hpp"
#include "ortung/sim_api/Stage.hpp"
#include "ortung/tables/FieldRegion.hpp"

namespace ortung {

/// Plans routes on a grid: on the largest connected part of the floor on which the robot's body
/// fits. Not thread-safe.
class ORTUNG_API RoutePlanner : public FloorPlan {
 public:
  /// @param clearance distance that routes keep from walls [m]; it is less where there is no room
  /// @throws std::invalid_argument if the robot fits nowhere
  RoutePlanner(const SimWorld& world, const RobotSize& robot, double clearance = 0.1);
  ~RoutePlanner() override;

  Pose2 randomPose(Random& random) const override;
  /// Returns a route by A*. Both ends are moved to the nearest cell of the free space first.
  std::vector<FloorPoint> route(const FloorPoint& from, const FloorPoint& to) const override;
  const FieldGrid& grid() const override { return grid_; }
  const std::vector<std::uint32_t>& cells() const override { return cells_; }
  /// Returns whether a point [m] lies in a cell of the free space.
  bool contains(double x, double y) const;

 private:
  void keepLargestPart();
  std::size_t nearestCell(const FloorPoint& point) const;
  bool isClear(std::size_t a, std::size_t b) const;
  std::vector<std::uint32_t> search(std::size_t from, std::size_t to) const;
  FloorPoint centre(std::size_t cell) const { return {grid_.centreX(cell), grid_.centreY(cell)}; }

  FieldGrid grid_;
  std::vector<std::uint8_t> free_;  ///< whether a cell belongs to the free space (1) or not (0)
  std::vector<std::uint32_t> cells_;
};

}  // namespace ortung
