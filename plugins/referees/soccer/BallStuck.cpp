#include "BallStuck.hpp"

#include <cmath>

namespace ortung::soccer {

bool BallStuck::look(const Scene::Ball& ball, Timestamp now) {
  if (!(rules_.time > 0.0)) return false;
  if (!anchor_ || std::hypot(ball.x - anchor_->x, ball.y - anchor_->y) > rules_.radius) {
    anchor_ = FloorPoint{ball.x, ball.y};
    since_ = now;
  }
  return toSeconds(now - since_) >= rules_.time;
}

}  // namespace ortung::soccer
