#pragma once

#include <string>

#include "Paths.hpp"
#include "ortung/served/ServedSimulation.hpp"

namespace ortung::test {

inline const std::string kF2000 = ORTUNG_SOURCE_DIR "/maps/fields/f2000.toml";
inline const std::string kPioneer = ORTUNG_SOURCE_DIR "/maps/robots/pioneer.toml";

/// Gives what a Pioneer without noise senses where it stands on that field, a cycle at a time.
/// @param use called with the readings of each cycle
template <class Use>
void standAt(const Pose2& pose, int cycles, const Use& use) {
  Scene scene;
  scene.world = kF2000;
  SceneRobot robot;
  robot.file = kPioneer;
  robot.name = "pioneer";
  robot.start = pose;
  scene.robots.push_back(robot);
  ServedSimulation world(scene, {.noise = false});
  for (int cycle = 0; cycle < cycles; ++cycle) {
    world.step();
    use(world.readings(1));
  }
}

}  // namespace ortung::test
