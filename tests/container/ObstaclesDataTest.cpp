#include <gtest/gtest.h>

#include "Files.hpp"
#include "ortung/formats/ObstaclesData.hpp"

namespace ortung {
namespace {

using test::messageOf;
using Words = std::vector<std::uint32_t>;

const SensorId kId{"M1", "T", "F"};

TEST(ObstaclesData, ReadsShapesAndNeverLocalizes) {
  ObstaclesData data(kId);
  ObstaclesData::Obstacle circle;
  circle.x = 1.0;
  circle.y = -2.0;
  circle.radius = 0.25;
  ObstaclesData::Obstacle segment;
  segment.shape = ObstaclesData::Shape::kSegment;
  segment.x = -1.0;
  segment.y = 0.5;
  segment.endX = 2.0;
  segment.endY = -0.5;
  data.setData(1, ObstaclesData::encode(std::vector{circle, segment}));
  ASSERT_EQ(data.reading().size(), 2u);
  EXPECT_NEAR(data.reading()[0].y, -2.0, 1e-9);
  EXPECT_NEAR(data.reading()[0].radius, 0.25, 1e-9);
  EXPECT_NEAR(data.reading()[1].x, -1.0, 1e-9);
  EXPECT_NEAR(data.reading()[1].endY, -0.5, 1e-9);
  EXPECT_FALSE(data.localizes());
}

TEST(ObstaclesData, RefusesHostileWords) {
  ObstaclesData data(kId);
  EXPECT_EQ(messageOf<std::invalid_argument>([&] { data.setData(2, Words{2, 0, 0, 0, 0}); }),
            "M1/T/F: found the shape 2, expected 0 for a circle or 1 for a segment");
  EXPECT_NE(messageOf<std::invalid_argument>([&] { data.setData(2, Words(4, 0)); }), "");
  EXPECT_NE(messageOf<std::invalid_argument>([&] { data.setData(2, Words(5 * 1025, 0)); }), "");
}

}  // namespace
}  // namespace ortung
