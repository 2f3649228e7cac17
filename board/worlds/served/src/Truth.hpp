#pragma once

#include <map>
#include <span>
#include <vector>

#include "ortung/core/Message.hpp"
#include "ortung/server/ServedWorld.hpp"
#include "ortung/sim/Simulation.hpp"

namespace ortung {

/// What is true of a simulated world, as readings of robot 0 (docs/protocol.md): where robots and
/// movable objects are. Not thread-safe.
class Truth {
 public:
  Truth();
  static std::vector<ServedFeature> features();
  /// @param numbers of the board's robots, by the simulation's
  /// @returns the readings of now; valid until the next call
  std::span<Message> look(const Simulation& simulation,
                          const std::map<RobotNumber, RobotId>& numbers);

 private:
  std::vector<Message> readings_;
};

}  // namespace ortung
