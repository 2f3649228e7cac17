#pragma once

#include <memory>
#include <span>
#include <vector>

#include "Mesh.hpp"
#include "ortung/sim_api/World.hpp"

namespace ortung {

/// Casts rays against fixed bodies; the only part that uses the ray tracing library. Thread-safe.
class RayCaster {
 public:
  /// @throws std::runtime_error when the ray tracing library fails
  explicit RayCaster(const Mesh& mesh);
  ~RayCaster();
  RayCaster(const RayCaster&) = delete;
  RayCaster& operator=(const RayCaster&) = delete;

  /// Casts a fan as World::castFan() does. @pre all numbers are finite, maxRange is not negative
  void castFan(const RayFan& fan, std::span<float> ranges) const;

  /// Returns whether the ray from a point in a direction meets anything before @p stop [m].
  bool isBlocked(const std::array<double, 3>& from, const std::array<double, 3>& direction,
                 double stop) const;

 private:
  struct Scenes;
  std::unique_ptr<Scenes> scenes_;
};

}  // namespace ortung
