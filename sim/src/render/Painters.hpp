#pragma once

#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "ScenePainter.hpp"
#include "WorldModel.hpp"

namespace ortung {

/// The painters of one scene, one for each thread that draws at the same time. The scene is
/// prepared, and OpenGL loaded, at the first drawing. Thread-safe.
class Painters {
 public:
  Painters();
  ~Painters();

  /// Draws the scene.
  /// @param objects objects of the world: first @p standing fixed ones, then the moving ones
  /// @throws std::runtime_error if there is no OpenGL
  void draw(const WorldModel& world, std::span<const WorldObject> objects, std::size_t standing,
            const Drawing& drawing, const Sheet& sheet);

 private:
  struct Painter;
  std::unique_ptr<Painter> take(const WorldModel& world, std::span<const WorldObject> standing);

  std::mutex mutex_;
  std::unique_ptr<const StandingScene> scene_;
  std::vector<std::unique_ptr<Painter>> idle_;
};

}  // namespace ortung
