#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ortung/sim_api/Game.hpp"
#include "ortung/sim_api/Stage.hpp"

namespace ortung::soccer {

/// A copy of the world's state in one cycle, as a referee sees it.
struct Scene {
  struct Ball {
    std::string name;
    double x = 0.0;       ///< x of its middle [m]
    double y = 0.0;       ///< y of its middle [m]
    double vx = 0.0;      ///< velocity along x [m/s]
    double vy = 0.0;      ///< velocity along y [m/s]
    double radius = 0.0;  ///< radius [m]
  };
  struct Robot {
    std::string name;
    std::optional<std::size_t> team;  ///< index of its team; nothing: it takes no part
    Pose2 pose;
    RobotSize size;
    double toBall = 0.0;  ///< gap between its body and the ball's edge [m]; huge without a ball
  };

  Timestamp now = 0;
  std::optional<Ball> ball;  ///< the first thing of kind "ball"
  std::vector<Robot> robots;

  /// Copies the state. @param ballRadius radius if the world does not give it [m]
  static Scene of(const Stage& stage, const Game& game, double ballRadius);

  const Robot* find(std::string_view name) const;
};

/// Returns the robot of a team that is nearest to a point; null if it has none.
const Scene::Robot* nearest(const Scene& scene, std::size_t team, const FloorPoint& point);

}  // namespace ortung::soccer
