#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "Files.hpp"
#include "Paths.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/mcl_served/LocalizedWorld.hpp"
#include "ortung/mcl_served/WorldTables.hpp"
#include "ortung/served/ServedSimulation.hpp"

namespace ortung::test {

/// A robot that wanders about in maps/fields/arena.toml, without noise.
struct LocalizedArena {
  LocalizedArena() {
    writeBytes(robotFile, R"([robot]
name = "scout"
radius_m = 0.2
[[sensor]]
plugin = "odometry"
[[sensor]]
plugin = "lrf"
beams = 31
fov_deg = 180
max_range_m = 8
perception = "rays"
[[sensor]]
plugin = "compass"
[mcl]
particles = 1000
)");
  }
  Scene scene() const {
    Scene scene;
    scene.world = worldFile;
    SceneRobot robot;
    robot.file = robotFile;
    robot.name = "scout";
    robot.start = Pose2{0.5, -1.5, kTurn / 4};
    robot.wanders = true;
    scene.robots.push_back(robot);
    return scene;
  }
  LocalizedWorld::Config config() const {
    LocalizedWorld::Config config;
    config.robotFile = [this](RobotId) { return robotFile; };
    config.tables = learnedTables(worldFile);
    return config;
  }

  const TemporaryFolder folder;
  const std::filesystem::path worldFile = ORTUNG_SOURCE_DIR "/maps/fields/arena.toml";
  const std::filesystem::path robotFile = folder / "scout.toml";
};

}  // namespace ortung::test
