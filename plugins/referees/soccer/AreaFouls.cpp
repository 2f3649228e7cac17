#include "AreaFouls.hpp"

namespace ortung::soccer {

std::optional<AreaFouls::Foul> AreaFouls::look(const Scene& scene, const Pitch& pitch,
                                               const Game& game) {
  struct Kind {
    std::optional<int> most;
    const AreaSize& area;
    double end;  ///< end of x as seen by the team: -1 is the own goal
    const char* name;
  };
  const std::array<Kind, 4> kinds = {
      Kind{rules_.ownGoal, pitch.goalArea, -1.0, "its own goal area"},
      Kind{rules_.ownPenalty, pitch.penaltyArea, -1.0, "its own penalty area"},
      Kind{rules_.otherGoal, pitch.goalArea, 1.0, "the other goal area"},
      Kind{rules_.otherPenalty, pitch.penaltyArea, 1.0, "the other penalty area"}};
  std::optional<Foul> foul;
  for (std::size_t team = 0; team < 2; ++team) {
    for (std::size_t i = 0; i < kinds.size(); ++i) {
      const Kind& kind = kinds[i];
      if (!kind.most) continue;
      const double side = kind.end * game.directionOf(game.teams[team].name);
      int there = 0;
      FloorPoint place;
      for (const Scene::Robot& robot : scene.robots) {
        if (robot.team != team || !pitch.isIn(kind.area, side, robot.pose.x, robot.pose.y))
          continue;
        ++there;
        place = {robot.pose.x, robot.pose.y};
      }
      auto& since = since_[team][i];
      if (there <= *kind.most) {
        since.reset();
        continue;
      }
      if (!since) since = scene.now;
      if (!foul && toSeconds(scene.now - *since) >= rules_.time)
        foul = Foul{team, place,
                    std::to_string(there) + " robots of " + game.teams[team].name + " in " +
                        kind.name + ", at most " + std::to_string(*kind.most) + " may be"};
    }
  }
  return foul;
}

}  // namespace ortung::soccer
