// What readings tell of a pose, as differences of simulated readings have it, beside closed forms.
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

#include "FakeRoom.hpp"
#include "SimulatedBound.hpp"
#include "ortung/formats/OdometryData.hpp"
#include "ortung/formats/ScanData.hpp"
#include "ortung/run/Feeder.hpp"
#include "ortung/run/OpenSource.hpp"
#include "ortung/run/Robot.hpp"

namespace ortung::app {
namespace {

namespace fs = std::filesystem;
using Matrix = std::array<double, 9>;

constexpr const char* kRoom = R"(
[world]
name = "room"
x_m = [-4, 4]
y_m = [-2.5, 2.5]
[[rectangle]]
kind = "wall"
center_m = [0, 2.55]
size_m = [8.2, 0.1]
[[rectangle]]
kind = "wall"
center_m = [0, -2.55]
size_m = [8.2, 0.1]
[[rectangle]]
kind = "wall"
center_m = [4.05, 0]
size_m = [0.1, 5]
[[rectangle]]
kind = "wall"
center_m = [-4.05, 0]
size_m = [0.1, 5]
[[landmark]]
kind = "post"
identity = 1
position_m = [1, 2, 0.5]
[[landmark]]
kind = "post"
identity = 2
position_m = [-3, -1, 0.5]
[[landmark]]
kind = "post"
identity = 3
position_m = [3, -2, 0.5]
)";

constexpr const char* kRobot = R"(
[robot]
name = "r"
radius_m = 0.2
[[sensor]]
plugin = "odometry"
period_s = 0.1
)";

/// Adds g g^T / sigma^2.
void add(const std::array<double, 3>& slope, double sigma, Matrix& information) {
  for (std::size_t k = 0; k < 9; ++k)
    information[k] += slope[k / 3] * slope[k % 3] / (sigma * sigma);
}

class SimulatedBoundTest : public testing::Test {
 protected:
  SimulatedBoundTest()
      : folder_(fs::temp_directory_path() / ("ortung_bound_" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
    std::ofstream(folder_ / "room.toml") << kRoom;
  }
  ~SimulatedBoundTest() override { fs::remove_all(folder_); }

  /// Drives about and compares each moment's information with the closed form.
  /// @param atLeast, atMost of the closed form, along each axis at each moment
  /// @param within of all moments together
  void expectInformation(const std::string& sensors, double atLeast, double atMost, double within,
                         const std::function<Matrix(const Pose2&)>& closedForm) {
    const fs::path file = folder_ / "robot.toml";
    std::ofstream(file) << kRobot << sensors;
    const auto robot = openRobot(file);
    const auto source = openSource(
        "sim:" + (folder_ / "room.toml").string() + "?duration=20&seed=2", file, robot->factory);
    Feeder feeder("sim", *source, robot->container);
    SimulatedBound bound(folder_ / "room.toml", file);
    while (feeder.next()) bound.look(robot->container, feeder.stamp(), feeder.truth());
    const std::vector<BoundStep> steps = bound.steps();
    ASSERT_GT(steps.size(), 190U);
    std::array<double, 9> sum{};
    std::array<double, 9> expectedSum{};
    for (const BoundStep& step : steps) {
      const Matrix expected = closedForm(step.truth);
      for (const std::size_t axis : {0U, 4U, 8U}) {
        EXPECT_GT(step.information[axis], atLeast * expected[axis]) << step.stamp << " " << axis;
        EXPECT_LT(step.information[axis], atMost * expected[axis]) << step.stamp << " " << axis;
        sum[axis] += step.information[axis];
        expectedSum[axis] += expected[axis];
      }
      for (const std::size_t axis : {1U, 2U, 5U})
        EXPECT_NEAR(step.information[axis], expected[axis],
                    std::max(1 - atLeast, atMost - 1) *
                        std::sqrt(expected[axis / 3 * 4] * expected[axis % 3 * 4]))
            << step.stamp << " " << axis;
    }
    for (const std::size_t axis : {0U, 4U, 8U})
      EXPECT_NEAR(sum[axis], expectedSum[axis], within * expectedSum[axis]) << axis;
  }

  fs::path folder_;
};

// Censi 2007: of a range r along u to a wall with normal n, dr/dplace = -n / (n u), dr/dheading =
// -r (n u_perp) / (n u). Those that end at the four corners are left out as edges; where a beam
// grazes a wall near its end, that may be a third of all that is known. Words are of 1 mm.
TEST_F(SimulatedBoundTest, OfAScannerInARoomIsThatOfCensi) {
  const test::Room room{8, 5};
  const auto slopeOf = [&room](const Pose2& pose, double beam) {
    const double angle = pose.theta + beam;
    const double range = room.range(pose.x, pose.y, angle);
    const double u[2] = {std::cos(angle), std::sin(angle)};
    const bool isSide = std::abs(std::abs(pose.x + range * u[0]) - 4.0) < 1e-9;
    const double n[2] = {isSide ? 1.0 : 0.0, isSide ? 0.0 : 1.0};
    const double along = n[0] * u[0] + n[1] * u[1];
    const double across = -n[0] * u[1] + n[1] * u[0];
    return std::array<double, 3>{-n[0] / along, -n[1] / along, -range * across / along};
  };
  // The formula itself, by differences of rays that are no simulator's.
  const Pose2 place{1.2, -0.7, 0.4};
  for (const double beam : {-1.2, -0.3, 0.35, 1.0}) {
    const auto slope = slopeOf(place, beam);
    constexpr double kStep = 1e-6;
    const auto range = [&](double dx, double dy, double turn) {
      return room.range(place.x + dx, place.y + dy, place.theta + beam + turn);
    };
    EXPECT_NEAR(slope[0], (range(kStep, 0, 0) - range(-kStep, 0, 0)) / (2 * kStep), 1e-6);
    EXPECT_NEAR(slope[1], (range(0, kStep, 0) - range(0, -kStep, 0)) / (2 * kStep), 1e-6);
    EXPECT_NEAR(slope[2], (range(0, 0, kStep) - range(0, 0, -kStep)) / (2 * kStep), 1e-6);
  }
  expectInformation(R"(
[[sensor]]
plugin = "lrf"
pose = { z_m = 0.3 }
period_s = 0.1
beams = 180
fov_deg = 180
max_range_m = 20
noise_sigma_m = 0.02
noise_sigma_per_m = 0
)",
                    0.6, 1.05, 0.04, [&](const Pose2& pose) {
                      Matrix information{};
                      for (int i = 0; i < 180; ++i)
                        add(slopeOf(pose, (-0.5 + i / 179.0) * test::kPi), 0.02, information);
                      return information;
                    });
}

// A beam at right angles to the face of a pillar tells the distance from it and nothing else, since
// it stays on the face. 12 mm from the face's edge, a step of 20 mm to this side goes past the
// pillar to the wall behind; one of half a degree does not, being 9 mm there: whatever bends along
// one axis alone must not be taken for a slope.
TEST_F(SimulatedBoundTest, OfABeamBesideAnEdgeIsThatOfTheFace) {
  const fs::path world = folder_ / "pillar.toml";
  std::ofstream(world) << kRoom << R"(
[[rectangle]]
center_m = [1.5, 0.0]
size_m = [1.0, 0.4]
)";
  const fs::path file = folder_ / "robot.toml";
  std::ofstream(file) << kRobot << R"(
[[sensor]]
plugin = "lrf"
pose = { z_m = 0.3 }
beams = 1
fov_deg = 1
max_range_m = 20
)";
  const auto robot = openRobot(file);
  SensorData* const odometry = robot->container.findExactly({"odometry", "odometry", "pose"});
  SensorData* scan = nullptr;
  for (const auto& data : robot->container.all())
    if (data->localizes()) scan = data.get();
  ASSERT_NE(odometry, nullptr);
  ASSERT_NE(scan, nullptr);
  SimulatedBound bound(world, file);
  constexpr Pose2 kPlaces[] = {{0.0, 0.188, 0.0}, {0.0, -0.188, 0.0}, {0.0, 0.0, 0.0}};
  constexpr int kTimes = 60;
  for (int i = 0; i < kTimes; ++i) {
    const Timestamp stamp = i * 100'000;
    odometry->setData(stamp, OdometryData::encode({}));
    std::vector<std::uint32_t> words;
    const float range = 1.0F + (i % 2 == 0 ? 0.02F : -0.02F);
    ScanData::encode({&range, 1}, 20.0F, words);
    scan->setData(stamp, words);
    bound.look(robot->container, stamp, kPlaces[i % 3]);
  }
  const std::vector<BoundStep> steps = bound.steps();
  ASSERT_EQ(steps.size(), std::size_t{kTimes});
  const double all = steps.front().information[0];
  EXPECT_GT(all, 0.5 / (0.02 * 0.02)) << "sigma is 2 cm";
  EXPECT_LT(all, 2 / (0.02 * 0.02));
  for (const BoundStep& step : steps)
    for (std::size_t k = 0; k < 9; ++k)
      EXPECT_NEAR(step.information[k], k == 0 ? all : 0.0, 1e-4 * all) << step.truth.y << " " << k;
}

// Of a distance to a point the slope is the direction from it; of a bearing it is across, by
// distance, and -1 by heading.
TEST_F(SimulatedBoundTest, OfLandmarksIsThatOfDirections) {
  constexpr double kPosts[3][2] = {{1, 2}, {-3, -1}, {3, -2}};
  constexpr double kBearing = 2.0 * test::kPi / 180.0;
  expectInformation(R"(
[[sensor]]
plugin = "landmarks"
kind = "post"
identities = [1, 2, 3]
features = "list"
pose = { z_m = 0.5 }
period_s = 0.1
fov_deg = 360
max_range_m = 20
range_sigma_m = 0.05
range_sigma_per_m = 0
bearing_sigma_deg = 2
outliers = 0.01
missed_share = 0
false_share = 0
)",
                    0.8, 1.2, 0.15, [&](const Pose2& pose) {  // sigmas of 600: to 5 %
                      Matrix information{};
                      for (const auto& post : kPosts) {
                        const double dx = pose.x - post[0];
                        const double dy = pose.y - post[1];
                        const double r = std::hypot(dx, dy);
                        add({dx / r, dy / r, 0}, 0.05, information);
                        add({-dy / (r * r), dx / (r * r), -1}, kBearing, information);
                      }
                      return information;
                    });
}

}  // namespace
}  // namespace ortung::app
