// Lines in rendered pictures: how many of those in sight are found, and whether what is found is
// one; and MCL on them, from an unknown start.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "Files.hpp"
#include "Learn.hpp"
#include "Paths.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/formats/LandmarksData.hpp"
#include "ortung/formats/ObjectsData.hpp"
#include "ortung/formats/PointsData.hpp"
#include "ortung/formats/PoseData.hpp"
#include "ortung/run/Localization.hpp"
#include "ortung/run/OpenSource.hpp"
#include "ortung/run/Robot.hpp"
#include "ortung/sim/SimWorld.hpp"
#include "ortung/vision/FieldLines.hpp"

namespace ortung::test {
namespace {

const std::string kWorld = ORTUNG_SOURCE_DIR "/maps/fields/msl.toml";
const std::string kRobot = ORTUNG_SOURCE_DIR "/maps/robots/msl_lines.toml";
constexpr double kReach = 6.0;   // [m]
constexpr double kBlind = 0.6;   // what the robot hides below it [m]
constexpr double kWithin = 0.1;  // [m]

struct Score {
  std::size_t right = 0, wrong = 0, seen = 0, missed = 0;
  double precision() const { return share(right, wrong); }
  double recall() const { return share(seen, missed); }
  static double share(std::size_t yes, std::size_t no) {
    return static_cast<double>(yes) / static_cast<double>(std::max<std::size_t>(1, yes + no));
  }
};

/// Places on all lines, 5 cm apart.
std::vector<Pose2> placesOn(const FieldLines& field) {
  std::vector<Pose2> places;
  constexpr double kStep = 0.05;
  for (const FieldLine& line : field.lines()) {
    if (line.shape == FieldLine::Shape::kStraight) {
      const double length = std::hypot(line.x1 - line.x0, line.y1 - line.y0);
      for (double d = 0.0; d <= length; d += kStep)
        places.push_back({line.x0 + (line.x1 - line.x0) * d / length,
                          line.y0 + (line.y1 - line.y0) * d / length, 0.0});
    } else if (line.width < line.radiusX) {  // spots are no lines
      for (double t = line.from; t <= line.to; t += kStep / line.radiusX)
        places.push_back(
            {line.x + line.radiusX * std::cos(t), line.y + line.radiusX * std::sin(t), 0.0});
    }
  }
  return places;
}

void count(const PointsData::Reading& points, const Pose2& robot, const FieldLines& field,
           const std::vector<Pose2>& places, Score& score) {
  std::vector<Pose2> found;
  for (const PointsData::Point& p : points) {
    found.push_back(robot *
                    Pose2{p.range * std::cos(p.bearing), p.range * std::sin(p.bearing), 0.0});
    const double away = field.nearest(found.back().x, found.back().y).distance;
    ++(away <= kWithin ? score.right : score.wrong);
  }
  for (const Pose2& place : places) {
    const double range = distance(place, robot);
    if (range > kReach - kWithin || range < kBlind) continue;
    const bool isSeen = std::any_of(found.begin(), found.end(),
                                    [&](const Pose2& p) { return distance(p, place) <= kWithin; });
    ++(isSeen ? score.seen : score.missed);
  }
}

/// Of a drive over the field.
Score scoreOf(const std::filesystem::path& robot) {
  const std::unique_ptr<Robot> opened = openRobot(robot);
  const auto source =
      openSource("sim:" + kWorld + "?duration=8&seed=5&speed=1.5", robot, opened->factory);
  const auto world = readWorld(kWorld);
  const FieldLines field(fieldModelOf(*world).lines);
  const std::vector<Pose2> places = placesOn(field);
  PointsData::Config config;
  config.maxRange = kReach;
  Score score;
  FrameReader frames(*source);
  std::vector<Message> frame;
  while (frames.next(frame)) {
    std::optional<Pose2> truth;
    bool hasLines = false;
    for (const Message& message : frame) {
      if (message.id.type == "groundTruth") {
        PoseData pose(message.id);
        pose.setData(message.stamp, message.words);
        truth = pose.reading();
      }
      hasLines = hasLines || message.id.feature == "lines";
    }
    if (!hasLines || !truth) continue;
    for (const Message& message : frame)
      if (message.id.feature == "lines") {
        PointsData points(message.id, {}, config);
        points.setData(message.stamp, message.words);
        count(points.reading(), *truth, field, places, score);
      }
  }
  return score;
}

TEST(RenderedLines, AreFoundAndNothingElseIs) {
  const TemporaryFolder folder;
  for (const char* variation : {"0", "1"}) {
    std::string text = readBytes(kRobot);
    text.replace(text.find("plugin = \"camera\"\n"), 18,
                 std::string("plugin = \"camera\"\nvariation = ") + variation + "\nseed = 7\n");
    // Every row and column, and all points that are found, not one in each square of 0.1 m.
    text.replace(text.find("see = [\"lines\", \"ball\", \"obstacles\"]"), 36,
                 "see = [\"lines\"]\nlines = { spacing_m = 0.02, spacing_px = 1 }\n");
    writeBytes(folder / "robot.toml", text);
    const Score score = scoreOf(folder / "robot.toml");
    std::printf("variation %s: precision %.4f of %zu points, recall %.4f of %zu places\n",
                variation, score.precision(), score.right + score.wrong, score.recall(),
                score.seen + score.missed);
    EXPECT_GT(score.right, 1000U);
    EXPECT_GE(score.precision(), 0.98);
    EXPECT_GE(score.recall(), 0.95);
  }
}

/// First reading of each feature that a robot in a scene or world has.
template <typename Format, typename... Settings>
typename Format::Reading firstOf(const std::string& source, const std::filesystem::path& robot,
                                 const std::string& feature, Settings... settings) {
  const std::unique_ptr<Robot> opened = openRobot(robot);
  const auto readings = openSource(source, robot, opened->factory);
  Message message;
  while (readings->next(message))
    if (message.id.feature == feature) {
      Format data(message.id, settings...);
      data.setData(message.stamp, message.words);
      return data.reading();
    }
  return {};
}

TEST(RenderedThings, BallAndRobotsAreSeenWhereTheyAre) {
  const TemporaryFolder folder;
  writeBytes(folder / "scene.toml", "[scene]\nworld = \"" + kWorld +
                                        "\"\nduration_s = 1\n"
                                        "[[robot]]\nfile = \"" +
                                        kRobot +
                                        "\"\nname = \"me\"\n"
                                        "start = { x_m = 2.0, y_m = -2.0, theta_deg = 30 }\n"
                                        "[[robot]]\nfile = \"" ORTUNG_SOURCE_DIR
                                        "/maps/robots/msl_omni.toml\"\nname = \"a\"\n"
                                        "start = { x_m = 4.0, y_m = -3.0, theta_deg = 180 }\n"
                                        "[[robot]]\nfile = \"" ORTUNG_SOURCE_DIR
                                        "/maps/robots/pioneer.toml\"\nname = \"b\"\n"
                                        "start = { x_m = 1.0, y_m = -5.1, theta_deg = 0 }\n");
  const std::string source = "sim:" + (folder / "scene.toml").string() + "?robot=me";
  const auto balls = firstOf<ObjectsData>(source, kRobot, "ball");
  ASSERT_EQ(balls.size(), 1U);  // on the middle of the field
  EXPECT_NEAR(balls[0].range, std::sqrt(8.0), 0.05);
  EXPECT_NEAR(balls[0].bearing, radians(105.0), radians(1.0));
  const auto robots = firstOf<ObjectsData>(source, kRobot, "obstacles");
  ASSERT_EQ(robots.size(), 2U);
  EXPECT_NEAR(robots[0].range, std::hypot(2.0, 1.0), 0.15);
  EXPECT_NEAR(robots[0].bearing, std::atan2(-1.0, 2.0) - radians(30.0), radians(3.0));
  EXPECT_NEAR(robots[1].range, std::hypot(1.0, 3.1), 0.15);
  EXPECT_NEAR(robots[1].bearing, std::atan2(-3.1, -1.0) - radians(30.0), radians(3.0));
}

TEST(RenderedThings, GoalsAreToldApartByTheirColours) {
  const TemporaryFolder folder;
  std::string text = readBytes(kRobot);
  text.replace(text.find("see = [\"lines\", \"ball\", \"obstacles\"]"), 36,
               "see = [\"goals\"]\nmax_range_m = 12\n[sensor.goals]\ndepth_m = 0.5\n"
               "[[sensor.goals.colour]]\nidentity = 1\nhue_deg = 240\n"
               "[[sensor.goals.colour]]\nidentity = 2\nhue_deg = 60\n");
  writeBytes(folder / "robot.toml", text);
  const auto goals = firstOf<LandmarksData>(
      std::string("sim:" ORTUNG_SOURCE_DIR "/maps/fields/f2000.toml?start=2,-1,30&speed=0"),
      folder / "robot.toml", "goals", Pose2{}, LandmarksData::Config{.identities = {1, 2}});
  ASSERT_EQ(goals.size(), 2U);
  EXPECT_EQ(goals[0].identity, 1U);
  EXPECT_NEAR(goals[0].range, std::hypot(8.0, 1.0), 0.8);  // a pixel there is 0.4 m
  EXPECT_NEAR(wrapAngle(goals[0].bearing - std::atan2(1.0, -8.0) + radians(30.0)), 0.0,
              radians(3.0));
  EXPECT_EQ(goals[1].identity, 2U);
  EXPECT_NEAR(goals[1].range, std::hypot(4.0, 1.0), 0.3);
  EXPECT_NEAR(goals[1].bearing, std::atan2(1.0, 4.0) - radians(30.0), radians(3.0));
}

TEST(RenderedThings, PostsAreSeenWhereTheyStand) {
  const TemporaryFolder folder;
  std::string text = readBytes(kRobot);
  text.replace(text.find("see = [\"lines\", \"ball\", \"obstacles\"]"), 36,
               "see = [\"posts\"]\nmax_range_m = 6\n[[sensor.posts.colour]]\nhue_deg = 240\n"
               "[[sensor.posts.colour]]\nhue_deg = 60\nhue_tolerance_deg = 8\n");
  writeBytes(folder / "robot.toml", text);
  PointsData::Config config;
  config.maxRange = 8.0;
  const auto posts = firstOf<PointsData>(
      std::string("sim:" ORTUNG_SOURCE_DIR "/maps/fields/f2000.toml?start=4,-2,30&speed=0"),
      folder / "robot.toml", "posts", Pose2{}, config);
  ASSERT_EQ(posts.size(), 1U) << "of the others one is too far, two are beyond the other goal";
  EXPECT_NEAR(posts[0].range, std::hypot(2.5, 2.5), 0.3);
  EXPECT_NEAR(posts[0].bearing, radians(-45.0 - 30.0), radians(3.0));
}

/// The whole field is searched, and the compass tells its halves apart.
TEST(RenderedLines, TellWhereARobotIsFromAnUnknownStart) {
  const TemporaryFolder folder;
  app::LearnArguments learn;
  learn.world = kWorld;
  learn.robot = kRobot;
  learn.out = folder / "msl.ortung";
  app::runLearn(learn);
  std::vector<double> errors;
  for (int seed = 1; seed <= 5; ++seed) {
    Localization localization(
        {.robot = kRobot,
         .tables = folder / "msl.ortung",
         .source = "sim:" + kWorld + "?duration=6&seed=" + std::to_string(seed),
         .seed = static_cast<std::uint64_t>(seed)});
    while (const auto estimate = localization.next()) {
      const auto& truth = localization.feeder().truth();
      if (!truth || estimate->stamp < fromSeconds(3.0)) continue;
      errors.push_back(distance(estimate->pose, *truth));
      EXPECT_LT(errors.back(), 0.3) << "seed " << seed;
    }
  }
  ASSERT_GT(errors.size(), 100U);
  std::sort(errors.begin(), errors.end());
  EXPECT_LT(errors[errors.size() / 2], 0.05);
}

}  // namespace
}  // namespace ortung::test
