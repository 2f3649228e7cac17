#pragma once

#include <array>
#include <optional>
#include <string>

#include "Pitch.hpp"
#include "Scene.hpp"

namespace ortung::soccer {

/// Sees more robots of a team in an area before a goal than the rules permit.
class AreaFouls {
 public:
  struct Foul {
    std::size_t team = 0;  ///< whose robots they are
    FloorPoint place;      ///< of the last one that came, as far as that is known [m]
    std::string text;
  };

  explicit AreaFouls(const Rules::Areas& rules) : rules_(rules) {}

  /// Once a cycle of play.
  std::optional<Foul> look(const Scene& scene, const Pitch& pitch, const Game& game);
  void reset() { since_ = {}; }

 private:
  Rules::Areas rules_;
  std::array<std::array<std::optional<Timestamp>, 4>, 2> since_{};  ///< by team and kind of area
};

}  // namespace ortung::soccer
