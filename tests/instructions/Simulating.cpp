#include <cmath>
#include <memory>
#include <numbers>

#include "HotCall.hpp"
#include "Paths.hpp"
#include "ortung/learning/Batch.hpp"
#include "ortung/sim/Simulation.hpp"

namespace ortung::instructions {
namespace {

constexpr int kRobots = 10;
constexpr int kBeams = 180;

void addRays(HotCalls& calls) {
  const std::shared_ptr<const SimWorld> world =
      readWorld(ORTUNG_SOURCE_DIR "/maps/fields/boxes18x12.toml");
  calls.push_back({"cast_fan", [=] {
                     std::vector<float> ranges(kBeams);
                     for (int i = 0; i < 100; ++i) {
                       RayFan fan;
                       fan.x = 0.05 * i - 2.5;
                       fan.y = 0.5;
                       fan.firstAngle = 0.1 * i;
                       fan.angleStep = 2.0 * std::numbers::pi / kBeams;
                       fan.maxRange = 8.0;
                       world->castFan(fan, {}, ranges);
                     }
                   }});
}

/// Ten robots of the Middle Size League that crowd the ball.
class Match {
 public:
  Match() : simulation_(readWorld(ORTUNG_SOURCE_DIR "/maps/fields/msl.toml"), {.seed = 3}) {
    RobotConfig config =
        readRobot(std::filesystem::path(ORTUNG_SOURCE_DIR "/maps/robots/msl_omni.toml"));
    std::erase_if(config.sensors,
                  [](const SensorConfig& one) { return one.plugin == "iconic_omnivision"; });
    for (int i = 0; i < kRobots; ++i) {
      config.name = "robot" + std::to_string(i);
      const double angle = 2.0 * std::numbers::pi / kRobots * i;
      simulation_
          .addRobot(config, factory_,
                    {2.0 * std::cos(angle), 2.0 * std::sin(angle), wrapAngle(angle + 3.1)})
          .drive()
          .setTranslationalVelocity(1.0);
    }
  }
  void play(int cycles) {
    for (int i = 0; i < cycles; ++i) simulation_.step();
  }

 private:
  PluginFactory factory_{PluginFactory::standardFolders()};
  Simulation simulation_;
};

void addEnvironments(HotCalls& calls) {
  using namespace learning;
  const auto batch =
      std::make_shared<Batch>("goalkeeper-v0", Options{}, BatchConfig{.episodes = 8});
  const std::vector<float> actions(batch->size() * batch->info().actionSize());
  calls.push_back({"environment_steps", [=] {
                     for (int i = 0; i < 10; ++i) batch->step(actions);
                   }});
}

}  // namespace

void addSimulation(HotCalls& calls) {
  addRays(calls);
  const auto match = std::make_shared<Match>();
  match->play(300);  // until they are at the ball
  calls.push_back({"match", [=] { match->play(20); }});
  addEnvironments(calls);
}

}  // namespace ortung::instructions
