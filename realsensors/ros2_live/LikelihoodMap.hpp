#pragma once

#include <chrono>
#include <functional>
#include <future>
#include <optional>
#include <string>
#include <vector>

#include "Participant.hpp"
#include "ortung/core/SensorData.hpp"
#include "ortung/ros2/Messages.hpp"
#include "ortung/run/FieldMaps.hpp"
#include "ortung/run/Robot.hpp"
#include "ortung/tables/Building.hpp"

namespace ortung::ros2 {

/// How probable the present readings are over the whole map (paper, Fig. 7b), as an OccupancyGrid
/// for RViz: 100 where they fit best, 0 where hardly, unknown where the robot can't be. It is made
/// only while somebody reads it, once a second at most, on a thread of its own. Not thread-safe.
class LikelihoodMap {
 public:
  /// @param frame of the map
  explicit LikelihoodMap(std::string frame) : frame_(std::move(frame)) {}
  ~LikelihoodMap() { finish(); }
  LikelihoodMap(const LikelihoodMap&) = delete;
  LikelihoodMap& operator=(const LikelihoodMap&) = delete;

  void connect(Participant& node);
  /// Tells the map of the robot's present readings, if it is time to and somebody reads it.
  /// @param heading of the robot [rad] @param floor that is told, in its own frame; nothing: all
  void tell(const Robot& robot, double heading, const std::optional<Floor>& floor = {});

  /// Waits until the map that is being made is told; before what tells it ends.
  void finish();

  /// The map of some readings. @param region whose open cells count
  static OccupancyGrid of(const FieldRegion& region, const Weighers& readings, double heading);

  /// The part of a region that is a floor's, at its place in the field.
  static FieldRegion partOf(const FieldRegion& region, const Floor& floor);

  static constexpr const char* kTopic = "likelihood_map";
  static constexpr std::size_t kMostCells = 250'000;

 private:
  const std::string frame_;
  Participant* node_ = nullptr;  ///< borrowed
  Participant::Sender send_;
  std::chrono::steady_clock::time_point next_;
  std::future<void> making_;
};

}  // namespace ortung::ros2
