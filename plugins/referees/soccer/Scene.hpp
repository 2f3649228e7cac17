#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ortung/sim_api/Game.hpp"
#include "ortung/sim_api/Stage.hpp"

namespace ortung::soccer {

/// What a referee has seen of the world at one moment; it stays as it is when the world changes.
struct Scene {
  struct Ball {
    std::string name;
    double x = 0.0;  ///< [m]
    double y = 0.0;
    double vx = 0.0;  ///< [m/s]
    double vy = 0.0;
    double radius = 0.0;  ///< [m]
  };
  struct Robot {
    std::string name;
    std::optional<std::size_t> team;  ///< nothing: it takes no part
    Pose2 pose;
    RobotSize size;
    double toBall = 0.0;  ///< gap between its body and the ball's edge [m]; huge without a ball
  };

  Timestamp now = 0;
  std::optional<Ball> ball;  ///< the first thing of kind "ball"
  std::vector<Robot> robots;

  /// @param ballRadius where the world does not tell [m]
  static Scene of(const Stage& stage, const Game& game, double ballRadius);

  const Robot* find(std::string_view name) const;
};

/// Of a team's robots the one that is nearest to a point, or null.
const Scene::Robot* nearest(const Scene& scene, std::size_t team, const FloorPoint& point);

}  // namespace ortung::soccer
