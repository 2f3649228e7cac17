#pragma once

#include <array>
#include <optional>
#include <string>

#include "Pitch.hpp"
#include "Scene.hpp"

namespace ortung::soccer {

/// Detects more robots of a team in an area before a goal than the rules permit.
class AreaFouls {
 public:
  struct Foul {
    std::size_t team = 0;  ///< index of the team
    FloorPoint place;      ///< place of the robot that entered last, as far as that is known [m]
    std::string text;
  };

  explicit AreaFouls(const Rules::Areas& rules) : rules_(rules) {}

  /// Observes a cycle; to be called once per cycle of play. @returns the foul, if there is one
  std::optional<Foul> look(const Scene& scene, const Pitch& pitch, const Game& game);
  void reset() { since_ = {}; }

 private:
  Rules::Areas rules_;
  /// Start of the excess, by team and kind of area.
  std::array<std::array<std::optional<Timestamp>, 4>, 2> since_{};
};

}  // namespace ortung::soccer
