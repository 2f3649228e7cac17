#pragma once

#include <optional>
#include <vector>

#include "Rules.hpp"
#include "ortung/sim_api/World.hpp"

namespace ortung::soccer {

/// Where lines and goals are. The field frame has its origin in the middle and the goals at the
/// ends of x, as all worlds with two goals have it. Lengths [m].
struct Pitch {
  double halfLength = 0.0;  ///< to the outer edge of the goal line
  double halfWidth = 0.0;   ///< to the outer edge of the touch line
  double halfGoal = 0.0;    ///< half the goal's inner width
  double goalDepth = 0.0;
  double circle = 0.0;       ///< radius of the centre circle; 0: none
  double penaltyMark = 0.0;  ///< from the goal line
  AreaSize goalArea;         ///< 0: none
  AreaSize penaltyArea;

  /// @throws ConfigError naming the key of [pitch] that is needed, if the world has neither two
  ///   goals nor such a key
  static Pitch of(const World& world, const Rules::Pitch& rules);

  /// Whether a point lies in the area before the goal at the end @p side (1 or -1) of x.
  bool isIn(const AreaSize& area, double side, double x, double y) const;
  /// The four restart marks of the rules, or none.
  std::vector<FloorPoint> marks(const Rules::Places& places) const;
};

}  // namespace ortung::soccer
