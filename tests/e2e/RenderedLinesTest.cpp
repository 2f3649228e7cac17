// Lines in rendered pictures: how many of those in sight are found, and whether what is found is
// one; and MCL on them, from an unknown start.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "Commands.hpp"
#include "Files.hpp"
#include "ortung/base/Angles.hpp"
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
    if (line.shape == FieldLine::Shape::straight) {
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
