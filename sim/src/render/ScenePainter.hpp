#pragma once

#include <memory>
#include <span>

#include "StandingScene.hpp"
#include "ortung/sim_api/Drawing.hpp"

namespace ortung {

/// Draws a scene with an OpenGL context of its own. It is used by one thread at a time.
class ScenePainter {
 public:
  /// @param scene borrowed @throws std::runtime_error if there is no OpenGL
  explicit ScenePainter(const StandingScene& scene);
  ~ScenePainter();
  ScenePainter(const ScenePainter&) = delete;
  ScenePainter& operator=(const ScenePainter&) = delete;

  /// @param moving the moving bodies to be drawn
  void draw(const Drawing& drawing, std::span<const Instance> moving, const Sheet& sheet);
  const char* backEnd() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace ortung
