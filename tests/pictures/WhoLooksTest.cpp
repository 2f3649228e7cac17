#include <gtest/gtest.h>

#include <algorithm>

#include "Paths.hpp"
#include "WorldFiles.hpp"
#include "ortung/camera/ImageData.hpp"
#include "ortung/core/PluginFactory.hpp"
#include "ortung/robot/RobotFile.hpp"
#include "ortung/sim/Simulation.hpp"

namespace ortung::test {
namespace {

/// A robot with a camera on the field.
struct RobotsRun {
  PluginFactory factory{PluginFactory::standardFolders()};
  Simulation simulation;
  SimRobot& robot;

  explicit RobotsRun(unsigned threads = 1, int robots = 1)
      : simulation(readWorld(ORTUNG_SOURCE_DIR "/maps/fields/msl.toml"),
                   {.seed = 3, .threads = threads}),
        robot(add(1)) {
    for (int i = 2; i <= robots; ++i) add(i);
  }
  SimRobot& add(int i) {
    RobotConfig config =
        readRobot(std::filesystem::path(ORTUNG_SOURCE_DIR "/maps/robots/msl_camera.toml"));
    config.name = "robot" + std::to_string(i);
    return simulation.addRobot(config, factory, {-4.0 + 1.5 * i, 2.0 - i, 0.4 * i});
  }
  std::vector<Message> pictures(int cycles) {
    std::vector<Message> found;
    for (int i = 0; i < cycles; ++i) {
      simulation.step();
      for (std::size_t r = 0; r < simulation.robots().size(); ++r)
        for (const Message& message : simulation.readings(r))
          if (message.id.feature == "image") found.push_back(message);
    }
    return found;
  }
};

TEST(Camera, DrawsNothingWhileNobodyLooks) {
  RobotsRun run;
  EXPECT_TRUE(run.pictures(30).empty());
  EXPECT_EQ(run.robot.container().find({.feature = "image"})->sequence(), 0u);
}

TEST(Camera, DrawsInItsPeriodWhileSomebodyLooks) {
  RobotsRun run;
  run.robot.setWanted({.feature = "image"}, true);
  const std::vector<Message> pictures = run.pictures(31);
  ASSERT_EQ(pictures.size(), 4u);  // every 100 ms, from the beginning on
  EXPECT_EQ(pictures[1].stamp - pictures[0].stamp, 100'000);
  EXPECT_EQ(pictures[0].words.size(), 3u + 480 * 480 * 3 / 4);
  const auto* image =
      dynamic_cast<const ImageData*>(run.robot.container().find({.feature = "image"}));
  ASSERT_NE(image, nullptr);
  EXPECT_TRUE(image->camera().has_value());
  EXPECT_EQ(image->reading().size, (ImageSize{480, 480}));
  run.robot.setWanted({.feature = "image"}, false);
  EXPECT_TRUE(run.pictures(30).empty());
}

TEST(Camera, DrawsTheSameWithAnyNumberOfThreads) {
  const auto all = [](unsigned threads) {
    RobotsRun run(threads, 4);
    for (const auto& robot : run.simulation.robots()) robot->setWanted({}, true);
    return run.pictures(21);
  };
  const std::vector<Message> alone = all(1);
  EXPECT_EQ(alone.size(), 12u);
  EXPECT_EQ(all(4), alone);
}

TEST(Camera, DoesNotSeeItsOwnRobot) {
  RobotsRun run;
  run.robot.setWanted({}, true);
  std::vector<Message> pictures = run.pictures(1);
  ASSERT_EQ(pictures.size(), 1u);
  // Beside the part that is left out there is floor, not the black of its body.
  const auto pixels = ImageData::pixelsOf(pictures[0].words);
  const std::size_t above = 3 * (std::size_t{480} * 180 + 240);
  EXPECT_GT(pixels[above + 1], 80);
}

// A server refuses robots that cost too much: four pixels are drawn in the time of a ray.
TEST(Camera, CostsAQuarterOfItsPixelsInRays) {
  PluginFactory factory(PluginFactory::standardFolders());
  Parameters sensor("robot.toml");
  Parameters camera("robot.toml");
  camera.set("size_px", std::vector<double>{320.0, 240.0});
  camera.set("focal_px", std::vector<double>{200.0, 200.0});
  sensor.set("camera", Parameters::Node{camera});
  EXPECT_DOUBLE_EQ(factory.make<Sensor>("camera", sensor)->rays(), 320 * 240 / 4);
}

TEST(Camera, WithSettingsOutOfBoundsIsRefusedWithTheKey) {
  PluginFactory factory(PluginFactory::standardFolders());
  Parameters sensor("robot.toml");
  Parameters camera("robot.toml");
  camera.set("size_px", std::vector<double>{6000.0, 480.0});
  camera.set("focal_px", std::vector<double>{400.0, 400.0});
  sensor.set("plugin", "camera");
  sensor.set("camera", Parameters::Node{camera});
  try {
    factory.makeData("camera", sensor);
    FAIL() << "took it";
  } catch (const ConfigError& error) {
    EXPECT_NE(std::string(error.what()).find("size_px"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("4096"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace ortung::test
