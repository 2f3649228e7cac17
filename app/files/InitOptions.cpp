#include "CommandModule.hpp"
#include "Init.hpp"
#include "OptionBuilder.hpp"

namespace ortung::app {
namespace {

void addInitRobot(Builder& build) {
  const auto a = build.command<InitRobotArguments>(
      "init robot", "ortung init robot --sensor lrf --sensor sonar --out robot.toml", runInitRobot);
  build.option("--out", a->out, "Robot file to write").showsDefault();
  build
      .option("--sensor", a->sensors,
              "Sensor that the robot has besides odometry, with all of its keys; may be given "
              "again; default: a laser scanner")
      .repeats();
  build.flag("--force", a->force, "Overwrite what is there");
}

void addInitWorld(Builder& build) {
  const auto a = build.command<InitWorldArguments>(
      "init world", "ortung init world --map map.yaml --out world.toml", runInitWorld);
  build.option("--out", a->out, "World file to write").showsDefault();
  build.option("--map", a->map, "Grid map that the world is; default: a room with walls");
  build.flag("--force", a->force, "Overwrite what is there");
}

void addInitSensor(Builder& build) {
  const auto a = build.command<InitSensorArguments>("init sensor", "ortung init sensor infrared",
                                                    runInitSensor);
  build.option("name", a->name, "Name of the plugin: a-z, 0-9, _").required();
  build.option("--out", a->out, "Folder to write; default: NAME");
  build.flag("--force", a->force,
             "Overwrite what is there, and take a name that another sensor has");
}

}  // namespace
}  // namespace ortung::app

ORTUNG_COMMAND_MODULE(ortung::app::addInitRobot, ortung::app::addInitWorld,
                      ortung::app::addInitSensor)
