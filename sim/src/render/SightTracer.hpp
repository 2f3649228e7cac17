#pragma once

#include <memory>
#include <mutex>
#include <span>

#include "WorldModel.hpp"
#include "ortung/sim_api/Drawing.hpp"

namespace ortung {

/// Finds what the rays of a camera meet: the same shapes as are drawn, each ray exactly, whatever
/// the camera's model. The fixed part is prepared for the first camera. Thread-safe.
class SightTracer {
 public:
  SightTracer();
  ~SightTracer();

  /// As World::trace().
  /// @param objects objects of the world: first @p standing fixed ones, then the moving ones
  void trace(const WorldModel& world, std::span<const WorldObject> objects, std::size_t standing,
             const Sight& sight, const Traced& traced);

 private:
  struct Ground;
  const Ground& ground(const WorldModel& world, std::span<const WorldObject> standing);

  std::mutex mutex_;
  std::unique_ptr<const Ground> ground_;
};

}  // namespace ortung
