// HEATMAP and WHY on the F2000 field, with a Pioneer whose readings have no noise.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <span>

#include "FakeRobots.hpp"
#include "LocalizedArena.hpp"
#include "Paths.hpp"
#include "StandingPioneer.hpp"
#include "TestClient.hpp"
#include "ortung/run/FieldMaps.hpp"

namespace ortung::test {
namespace {

/// From each its scanner sees walls on two sides: one wall alone looks alike all along.
std::vector<Pose2> placesOfF2000() {
  return {{1.53, -0.72, 0.6}, {-4.21, 2.64, -2.1}, {3.87, 3.11, 0.4}};
}

/// A simulated Pioneer, and the one that perceives what it senses.
class Pioneer {
 public:
  Pioneer() : perceiver_(openRobot(kPioneer)) {
    const auto goOn = [](double) { return true; };
    perceiver_ = openRobot(kPioneer, *learnedTables(kF2000)(*perceiver_, goOn));
  }
  std::shared_ptr<const Robot> robot() const { return perceiver_; }
  /// Whatever its sensors see in the first tenth of a second.
  void standAt(const Pose2& pose) {
    test::standAt(pose, 15,
                  [&](const std::span<Message> readings) { perceiver_->container.set(readings); });
  }

 private:
  std::shared_ptr<Robot> perceiver_;
};

struct Map {
  explicit Map(const BoardCommand::Reply& reply) : bytes(reply.bytes) {
    const auto number = [&](const char* key) { return std::stod(valueOf(reply.words, key)); };
    grid = {number("x_min_m"), number("y_min_m"), number("step_m"),
            static_cast<int>(number("columns")), static_cast<int>(number("rows"))};
    EXPECT_EQ(bytes.size(), grid.size());
  }
  int at(std::size_t cell) const { return static_cast<unsigned char>(bytes[cell]); }
  /// Of the cell that holds the place and those around it.
  int brightestAround(const Pose2& place) const {
    int best = 0;
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        const auto cell = grid.cellAt(place.x + dx * grid.cell, place.y + dy * grid.cell);
        if (cell >= 0) best = std::max(best, at(static_cast<std::size_t>(cell)));
      }
    return best;
  }
  /// How far the brightest cell is from that of the place, in cells.
  double cellsFrom(const Pose2& place) const {
    std::size_t best = 0;
    for (std::size_t i = 0; i < bytes.size(); ++i)
      if (at(i) > at(best)) best = i;
    return std::max(std::abs(grid.centreX(best) - place.x),
                    std::abs(grid.centreY(best) - place.y)) /
           grid.cell;
  }
  FieldGrid grid;
  std::string bytes;
};

std::string headingOf(const Pose2& pose) { return " theta_rad=" + std::to_string(pose.theta); }

TEST(HeatMap, OfEveryProductIsBrightestWhereTheRobotIs) {
  Pioneer pioneer;
  FakeRobots robots(pioneer.robot());
  const Asking client(robots);
  for (const Pose2& pose : placesOfF2000()) {
    pioneer.standAt(pose);
    std::size_t features = 0;
    for (const auto& data : pioneer.robot()->container.all()) {
      if (!data->canWeigh()) continue;
      ++features;
      const Map map(client.ask("HEATMAP robot=7 " + toText(data->id()) + headingOf(pose)));
      EXPECT_GE(map.brightestAround(pose), 250) << toText(data->id()) << " at " << pose.x;
      EXPECT_EQ(*std::max_element(map.bytes.begin(), map.bytes.end(),
                                  [](char a, char b) {
                                    return static_cast<unsigned char>(a) <
                                           static_cast<unsigned char>(b);
                                  }),
                '\xff');
    }
    EXPECT_GE(features, 9U);
    // What tells the place by itself. A scan knows no colours, and the field looks alike when
    // turned.
    for (const std::string what : {"", "omnivision/*/*"})
      EXPECT_LE(Map(client.ask("HEATMAP robot=7 " + what)).cellsFrom(pose), 1.0) << what;
    EXPECT_LE(Map(client.ask("HEATMAP LMS200/LRF/*" + headingOf(pose))).cellsFrom(pose), 1.0);
  }
}

TEST(HeatMap, IsThatOfTheLibraryInLevelsAndCoarserIfAskedFor) {
  Pioneer pioneer;
  FakeRobots robots(pioneer.robot());
  const Asking client(robots);
  const Pose2 pose = placesOfF2000().front();
  pioneer.standAt(pose);
  const Robot& robot = *pioneer.robot();
  const SensorData* scan = robot.container.find({.type = "LRF"});
  const BoardCommand::Reply reply = client.ask("HEATMAP LMS200/LRF/* theta_deg=30");
  const std::vector<double> expected =
      probabilityMap(robot.tables.region, weighersOf(std::vector{scan}), std::vector{kTurn / 12});
  const double low = std::stod(valueOf(reply.words, "low"));
  const double high = std::stod(valueOf(reply.words, "high"));
  const Map map(reply);
  ASSERT_EQ(map.grid, robot.tables.region.grid);
  double brightest = 0.0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(map.at(i) == 0, robot.tables.region.open[i] == 0);
    if (map.at(i) == 0) continue;
    brightest = std::max(brightest, expected[i]);
    EXPECT_NEAR(low + (high - low) * (map.at(i) - 1) / 254.0, expected[i], (high - low) / 500.0);
  }
  EXPECT_NEAR(high, brightest, 1e-6 * brightest);

  const BoardCommand::Reply inLogs = client.ask("HEATMAP LMS200/LRF/* theta_deg=30 scale=log");
  const Map logs(inLogs);
  const double range = std::log(high / low);
  EXPECT_NEAR(std::log(std::stod(valueOf(inLogs.words, "high")) / high), 0.0, 1e-6);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    if (logs.at(i) == 0) continue;
    EXPECT_NEAR((logs.at(i) - 1) / 254.0, std::log(expected[i] / low) / range, 1.0 / 500.0);
  }

  const Map coarse(client.ask("HEATMAP cells=1000"));
  EXPECT_LE(coarse.grid.size(), 1000U);
  EXPECT_DOUBLE_EQ(coarse.grid.cell, 0.4) << "14 x 10 m: 35 x 25 cells";
  EXPECT_EQ(coarse.grid.columns, 35);

  const BoardCommand::Reply bearing =
      client.ask("HEATMAP omnivision/camera/goal2Bearing of=expectation theta_deg=90");
  EXPECT_EQ(valueOf(bearing.words, "unit"), "rad");
  EXPECT_EQ(valueOf(bearing.words, "values"), "1");
  const double least = std::stod(valueOf(bearing.words, "low"));
  const double most = std::stod(valueOf(bearing.words, "high"));
  const Map field(bearing);
  for (double x = -4.0; x <= 3.0; x += 1.0)
    for (double y = -3.0; y <= 3.0; y += 1.0) {
      const auto cell = static_cast<std::size_t>(field.grid.cellAt(x, y));
      const double told = least + (most - least) * (field.at(cell) - 1) / 254.0;
      const double geometry = std::atan2(-y, 6.0 - x) - kTurn / 4;  // to the goal in (6, 0)
      EXPECT_NEAR(told, geometry, 0.05) << x << ", " << y << ": a level is 0.025 rad, a cell 0.1 m";
    }
}

TEST(Why, TellsWhatTheContainerSaysAndEachFeaturesShare) {
  Pioneer pioneer;
  FakeRobots robots(pioneer.robot());
  const Asking client(robots);
  const Pose2 pose = placesOfF2000().front();
  pioneer.standAt(pose);
  const SensorContainer& container = pioneer.robot()->container;
  const Pose2 other{1.8, -0.5, 0.7};
  for (const Pose2& asked : {pose, other}) {
    const BoardCommand::Reply reply =
        client.ask("WHY robot=7 x_m=" + std::to_string(asked.x) +
                   " y_m=" + std::to_string(asked.y) + headingOf(asked));
    const double p = container.getProbability(asked);
    EXPECT_NEAR(std::stod(valueOf(reply.words, "p")), p, 1e-4 * p) << "poses in six digits";
    double product = 1.0;
    std::size_t values = 0;
    for (const std::string& line : reply.lines) {
      if (line.starts_with("value ")) {
        ++values;
        continue;
      }
      const SensorData* feature =
          container.findExactly(parseSensorId(line.substr(0, line.find(' '))));
      ASSERT_NE(feature, nullptr) << line;
      const double share = std::stod(valueOf(line, "p"));
      EXPECT_NEAR(share, feature->getProbability(asked), 1e-4);
      if (share >= 0.0) product *= share;
    }
    EXPECT_NEAR(product, p, 1e-3 * p);
    EXPECT_EQ(values, 192U) << "180 beams, 6 distances and 6 bearings";
  }
  const auto lines =
      client.ask("WHY x_m=0 y_m=1 theta_deg=90 omnivision/camera/goal2Bearing").lines;
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_TRUE(lines[1].starts_with("value omnivision/camera/goal2Bearing 0 unit=rad measured="));
  EXPECT_NEAR(std::stod(valueOf(lines[1], "expected")), std::atan2(-1.0, 6.0) - kTurn / 4, 0.02);
  const double seen = std::atan2(-pose.y, 6.0 - pose.x) - pose.theta;
  EXPECT_NEAR(std::stod(valueOf(lines[1], "measured")), seen, 0.02);
}

}  // namespace
}  // namespace ortung::test
