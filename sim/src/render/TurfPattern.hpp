#pragma once

#include <cstdint>
#include <span>

#include "StandingScene.hpp"
#include "ortung/sim_api/Drawing.hpp"

namespace ortung {

/// Gives the floor of a drawing its grain, patches and mown stripes. OpenGL by software takes
/// longer for a pattern than for everything else, so it is added to what it has drawn: pixel by
/// pixel, to the floor's share. All instruction sets give the same bits.
class TurfPattern {
 public:
  /// @param scene borrowed
  TurfPattern(const StandingScene& scene, const Lighting& light);

  /// Returns whether there is any pattern.
  static bool isIn(const Lighting& light);

  /// Adds the pattern to all faces. @param colours as Sheet::colours, but alpha is the share of a
  /// pixel that is not floor
  void add(const Drawing& drawing, std::span<std::uint32_t> colours) const;

 private:
  void add(const Drawing& drawing, const SheetFace& face, std::span<std::uint32_t> colours) const;

  const StandingScene& scene_;
  const Lighting& light_;
  float shiftX_, shiftY_;  ///< place of the scene's middle on the tiles [m]
};

}  // namespace ortung
