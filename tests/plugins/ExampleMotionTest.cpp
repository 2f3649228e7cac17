// The plugin that docs/motion.md shows, compiled from there.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "ortung/core/PluginFactory.hpp"
#include "ortung/motion/MotionModel.hpp"
#include "ortung/robot/TomlFile.hpp"
#include "ortung/sim_api/Drive.hpp"

namespace ortung {
namespace {

TEST(ExampleMotion, MovesSamplesByWhatOdometrySaysWithTheNoiseOfItsKey) {
  PluginFactory factory({TEST_EXAMPLES});
  const auto model = factory.make<MotionModel>("cart", parseToml("way_per_m = 0.2", "test.toml"));
  constexpr std::size_t kSamples = 20000;
  std::vector<float> x(kSamples, 1.0F);
  std::vector<float> y(kSamples, 2.0F);
  std::vector<float> theta(kSamples, static_cast<float>(std::acos(-1.0) / 2));  // it looks along y
  model->sampleMotion({x, y, theta}, {4.0, 0.0, 0.0}, 1, 1, 0);
  double mean = 0.0;
  double squares = 0.0;
  double sideways = 0.0;
  for (std::size_t i = 0; i < kSamples; ++i) {
    mean += y[i] / kSamples;
    squares += (y[i] - 6.0) * (y[i] - 6.0) / kSamples;
    sideways += (x[i] - 1.0) * (x[i] - 1.0) / kSamples;
  }
  EXPECT_NEAR(mean, 6.0, 0.02);
  EXPECT_NEAR(std::sqrt(squares), 0.403, 0.01);  // 0.2 * sqrt(4 m) + 0.003
  EXPECT_NEAR(std::sqrt(sideways), 0.403, 0.01);
}

TEST(ExampleMotion, DrivesAsItIsToldWithinItsLimit) {
  PluginFactory factory({TEST_EXAMPLES});
  const auto drive = factory.make<Drive>("cart", parseToml("max_speed_m_s = 0.5", "test.toml"));
  drive->setTranslationalVelocity(2.0);
  const Pose2 way = drive->relocate(0.1, nullptr);
  EXPECT_NEAR(way.x, 0.05, 1e-12);
  EXPECT_EQ(drive->velocity().x, 0.5);
  EXPECT_EQ(drive->measure(way, nullptr).x, way.x);
  EXPECT_THROW(factory.make<Drive>("cart", parseToml("max_speed = 1", "test.toml")), ConfigError);
}

}  // namespace
}  // namespace ortung
