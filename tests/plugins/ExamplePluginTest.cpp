// The plugin that docs/sensors.md shows, compiled from there.
#include <gtest/gtest.h>

#include <cmath>

#include "FakeWorld.hpp"
#include "ortung/core/PluginFactory.hpp"
#include "ortung/formats/ConeData.hpp"
#include "ortung/robot/TomlFile.hpp"
#include "ortung/sim_api/Sensor.hpp"

namespace ortung {
namespace {

TEST(ExamplePlugin, LoadsMeasuresLearnsAndWeighs) {
  PluginFactory factory({TEST_EXAMPLES});
  const Parameters settings = parseToml("max_range_m = 3\nsigma_m = 0.05", "test.toml");
  const auto features = factory.makeData("infrared", settings);
  const auto sensor = factory.make<Sensor>("infrared", settings);
  ASSERT_EQ(features.size(), 1u);
  auto& data = dynamic_cast<ConeData&>(*features[0]);
  EXPECT_EQ(toText(data.id()), "GP2D12/infrared/front");
  SensorData* const list[] = {&data};

  const FakeWorld room(4.0, 4.0);
  RobotState state;
  state.pose = {0.5, 0.0, 0.0};
  sensor->generateData(room, state, nullptr, 1, list);
  EXPECT_NEAR(data.reading(), 1.3, 0.00051);  // 2 - 0.5 - 0.2 m

  // Learned as every other feature, by whoever sweeps.
  const FieldRegion region = room.region(0.1, {0.2});
  data.beginLearning(region, 0.1);
  const auto headings = static_cast<int>(std::ceil(2 * std::acos(-1.0) / data.headingSpacing()));
  for (std::size_t cell = 0; cell < region.grid.size(); ++cell) {
    for (int k = 0; k < headings; ++k) {
      const Pose2 place{region.grid.centreX(cell), region.grid.centreY(cell),
                        wrapAngle(k * data.headingSpacing())};
      state.pose = place * inverse(data.mount());
      sensor->generateData(room, state, nullptr, 2, list);
      data.learnProbability(state.pose);
    }
  }
  data.endLearning();
  state.pose = {0.5, 0.0, 0.0};
  sensor->generateData(room, state, nullptr, 3, list);
  EXPECT_GT(data.getProbability({0.5, 0.0, 0.0}), 0.5);
  EXPECT_LT(data.getProbability({-0.5, 0.0, 0.0}), 0.1);

  EXPECT_THROW(factory.makeData("infrared", parseToml("max_rang_m = 3", "test.toml")), ConfigError);
}

}  // namespace
}  // namespace ortung
