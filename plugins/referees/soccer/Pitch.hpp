#pragma once

#include <optional>
#include <vector>

#include "Rules.hpp"
#include "ortung/sim_api/World.hpp"

namespace ortung::soccer {

/// The places of lines and goals. The origin of the field frame is in the middle and the goals are
/// at the ends of x, as in all worlds with two goals. Lengths are in [m].
struct Pitch {
  double halfLength = 0.0;  ///< distance from the middle to the outer edge of the goal line
  double halfWidth = 0.0;   ///< distance from the middle to the outer edge of the touch line
  double halfGoal = 0.0;    ///< half the goal's inner width
  double goalDepth = 0.0;
  double circle = 0.0;  ///< radius of the centre circle; 0: none
  /// Distance of the penalty mark distance of the penalty mark from the goal line.
  double penaltyMark = 0.0;
  AreaSize goalArea;  ///< goal area; 0: none
  AreaSize penaltyArea;

  /// Finds the pitch from a world's lines and bodies; keys of the rules take precedence.
  /// @throws ConfigError naming the key of [pitch] that is needed, if the world has neither two
  ///   goals nor such a key
  static Pitch of(const World& world, const Rules::Pitch& rules);

  /// Returns whether a point lies in the area before the goal at the end @p side (1 or -1) of x.
  bool isIn(const AreaSize& area, double side, double x, double y) const;
  /// Returns the four restart marks of the rules, or none.
  std::vector<FloorPoint> marks(const Rules::Places& places) const;
};

}  // namespace ortung::soccer
