#pragma once

#include <box2d/box2d.h>

#include <span>
#include <vector>

namespace ortung::bench {

/// The arena in Box2D alone, as somebody would write it who needs nothing else: bodies, velocities
/// set in every step, and the engine's own ray cast. What all simulators on it have to be compared
/// with.
class BareBox2d {
 public:
  /// @param robots the first of kArenaStarts
  explicit BareBox2d(std::size_t robots);
  /// One cycle of 10 ms.
  void step();
  /// 180 ranges of all robots, one after the other [m].
  void cast(std::vector<float>& ranges) const;

 private:
  b2World world_{{0.0f, 0.0f}};
  std::vector<b2Body*> robots_;
};

}  // namespace ortung::bench
