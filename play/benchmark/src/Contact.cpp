#include "Contact.hpp"

#include <algorithm>
#include <limits>

#include "ortung/sim/Primitive.hpp"

namespace ortung {

double distanceToPieces(const SimRobot& robot, const Simulation::Thing& thing) {
  const Pose2 place = inverse(robot.state().pose) * thing.pose;
  double nearest = std::numeric_limits<double>::infinity();
  const auto look = [&](const std::vector<Primitive>& pieces) {
    for (const Primitive& piece : pieces)
      nearest = std::min(nearest, distanceTo(piece, {place.x, place.y}));
  };
  const RobotShape& shape = robot.shape();
  look(shape.pieces);
  for (std::size_t i = 0; i < shape.manipulators.size(); ++i)
    look(shape.manipulators[i].states[robot.manipulatorStates()[i]].pieces);
  return nearest;
}

}  // namespace ortung
