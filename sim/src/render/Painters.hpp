#pragma once

#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "ScenePainter.hpp"
#include "WorldModel.hpp"

namespace ortung {

/// Painters of one scene: as many as threads draw at a time. The scene is prepared, and OpenGL
/// looked for, when something is drawn first. Thread-safe.
class Painters {
 public:
  Painters();
  ~Painters();

  /// @param objects of the world: first what stands, then what moves
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
