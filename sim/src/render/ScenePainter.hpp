#pragma once

#include <memory>
#include <span>

#include "StandingScene.hpp"
#include "ortung/sim_api/Drawing.hpp"

namespace ortung {

/// Draws a scene with a context of OpenGL of its own. Used by one thread at a time.
class ScenePainter {
 public:
  /// @param scene must stay @throws std::runtime_error if there is no OpenGL
  explicit ScenePainter(const StandingScene& scene);
  ~ScenePainter();
  ScenePainter(const ScenePainter&) = delete;
  ScenePainter& operator=(const ScenePainter&) = delete;

  /// @param moving what moves, and is to be drawn
  void draw(const Drawing& drawing, std::span<const Instance> moving, const Sheet& sheet);
  const char* backEnd() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace ortung
