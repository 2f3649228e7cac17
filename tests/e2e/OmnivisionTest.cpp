// A robot that sees lines and goals on the field of today, where both halves look alike, with and
// without a compass, from an unknown start.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>

#include "Files.hpp"
#include "Learn.hpp"
#include "Paths.hpp"
#include "ortung/run/Localization.hpp"

namespace ortung::test {
namespace {

const std::string kWorld = ORTUNG_SOURCE_DIR "/maps/fields/msl.toml";
const std::string kRobot = ORTUNG_SOURCE_DIR "/maps/robots/msl_omni.toml";

/// Whether two poses agree as well as the robot should: 0.3 m, 5 degrees.
bool isNear(const Pose2& a, const Pose2& b) {
  return distance(a, b) < 0.3 &&
         std::abs(wrapAngle(a.theta - b.theta)) < 5.0 * std::numbers::pi / 180.0;
}

/// The pose from which the field looks the same.
Pose2 mirrored(const Pose2& pose) {
  return {-pose.x, -pose.y, wrapAngle(pose.theta + std::numbers::pi)};
}

struct Counts {
  int steps = 0;
  int right = 0;
  int mirrored = 0;
  double worst = 0.0;  ///< error of the right ones [m]
};

class Omnivision : public testing::Test {
 protected:
  void learn(const std::filesystem::path& robot) {
    robot_ = robot;
    app::LearnArguments learn;
    learn.world = kWorld;
    learn.robot = robot;
    learn.out = folder_ / "msl.ortung";
    app::runLearn(learn);
  }

  /// What 15 s of a drive give after the first 5 s.
  Counts drive(int seed) const {
    Localization localization(
        {.robot = robot_,
         .tables = folder_ / "msl.ortung",
         .source = "sim:" + kWorld + "?duration=15&seed=" + std::to_string(seed),
         .seed = static_cast<std::uint64_t>(seed)});
    Counts counts;
    while (const auto estimate = localization.next()) {
      const auto& truth = localization.feeder().truth();
      if (!truth || estimate->stamp < fromSeconds(5.0)) continue;
      ++counts.steps;
      if (isNear(estimate->pose, *truth)) {
        ++counts.right;
        counts.worst = std::max(counts.worst, distance(estimate->pose, *truth));
      }
      counts.mirrored += isNear(estimate->pose, mirrored(*truth)) ? 1 : 0;
    }
    return counts;
  }

  /// The robot that ships, with odometry and the sensors of these plugins alone.
  std::filesystem::path robotWith(const std::vector<std::string>& plugins,
                                  const std::string& another = "") const {
    const std::string kSensor = "[[sensor]]\n";
    std::string text = readBytes(kRobot);
    std::size_t begin = text.find(kSensor);
    while (begin != std::string::npos) {
      const std::size_t end = std::min(text.find(kSensor, begin + 1), text.size());
      const bool stays =
          std::any_of(plugins.begin(), plugins.end(), [&](const std::string& plugin) {
            return text.find("plugin = \"" + plugin + "\"", begin) < end;
          });
      if (!stays) text.erase(begin, end - begin);
      begin = text.find(kSensor, stays ? begin + 1 : begin);
    }
    std::ofstream(folder_ / "robot.toml") << text << another;
    return folder_ / "robot.toml";
  }

  TemporaryFolder folder_;
  std::filesystem::path robot_;
};

TEST_F(Omnivision, FindsItselfFromAnUnknownStartWithACompass) {
  learn(robotWith({"odometry", "iconic_omnivision", "compass"}));
  for (const int seed : {1, 2, 3, 4}) {
    const Counts counts = drive(seed);
    EXPECT_GT(counts.steps, 90) << seed;
    EXPECT_EQ(counts.right, counts.steps) << seed;
    EXPECT_LT(counts.worst, 0.1) << seed;  // two cells of the lines' field
  }
}

TEST_F(Omnivision, AloneIsRightOrExactlyHalfATurnOff) {
  learn(robotWith({"odometry", "iconic_omnivision"}));
  Counts all;
  for (const int seed : {1, 2, 3, 4}) {
    const Counts counts = drive(seed);
    all.steps += counts.steps;
    all.right += counts.right;
    all.mirrored += counts.mirrored;
  }
  EXPECT_EQ(all.right + all.mirrored, all.steps);
  // Nothing tells the halves apart, so both happen.
  EXPECT_GT(all.right, 0);
  EXPECT_GT(all.mirrored, 0);
}

/// A scanner that finds its position by itself.
class IconicLaser : public Omnivision {};

TEST_F(IconicLaser, FindsItselfByWallsAndGoalsWithACompass) {
  learn(robotWith({"odometry", "compass"}, R"(
[[sensor]]
plugin = "lrf_iconic"
pose = { x_m = 0.1, z_m = 0.25 }
beams = 360
fov_deg = 360
max_range_m = 30
noise_sigma_m = 0.03
)"));
  for (const int seed : {1, 2}) {
    const Counts counts = drive(seed);
    EXPECT_GT(counts.steps, 90) << seed;
    EXPECT_EQ(counts.right, counts.steps) << seed;
    EXPECT_LT(counts.worst, 0.15) << seed;
  }
}

}  // namespace
}  // namespace ortung::test
