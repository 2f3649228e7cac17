#include "BenchField.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <limits>
#include <map>
#include <numbers>

#include "ortung/base/Random.hpp"
#include "ortung/formats/ScanData.hpp"

namespace ortung::bench {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();
constexpr double kGoalDepth = 0.75;
constexpr double kGoalWidth = 2.4;
constexpr double kPostRadius = 0.1;
constexpr std::uint64_t kSeed = 2024;

struct Point {
  double x;
  double y;
};
constexpr std::array<Point, 4> kPosts{{{6, 4}, {6, -4}, {-6, 4}, {-6, -4}}};

struct Box {
  double left;
  double right;
  double bottom;
  double top;
};
constexpr std::array<Box, 2> kGoals{{
    {-kLength / 2, -kLength / 2 + kGoalDepth, -kGoalWidth / 2, kGoalWidth / 2},
    {kLength / 2 - kGoalDepth, kLength / 2, -kGoalWidth / 2, kGoalWidth / 2},
}};

/// Ways along the ray at which it enters and leaves an axis-parallel box.
std::array<double, 2> crossBox(const Box& box, Point from, Point direction) {
  const auto slab = [](double low, double high, double at, double along) -> std::array<double, 2> {
    if (along == 0.0) {
      if (at < low || at > high) return {kFar, -kFar};
      return {-kFar, kFar};
    }
    const double a = (low - at) / along;
    const double b = (high - at) / along;
    return {std::min(a, b), std::max(a, b)};
  };
  const auto x = slab(box.left, box.right, from.x, direction.x);
  const auto y = slab(box.bottom, box.top, from.y, direction.y);
  return {std::max(x[0], y[0]), std::min(x[1], y[1])};
}

double enterCircle(Point centre, Point from, Point direction) {
  const Point to{centre.x - from.x, centre.y - from.y};
  const double along = to.x * direction.x + to.y * direction.y;
  const double squared = kPostRadius * kPostRadius - (to.x * to.x + to.y * to.y - along * along);
  if (squared < 0.0) return kFar;
  const double way = along - std::sqrt(squared);
  return way > 0.0 ? way : kFar;
}

FieldRegion makeRegion() {
  FieldRegion region;
  region.grid = {-kLength / 2, -kWidth / 2, kCell, static_cast<int>(std::lround(kLength / kCell)),
                 static_cast<int>(std::lround(kWidth / kCell))};
  region.open.resize(region.grid.size());
  for (std::size_t cell = 0; cell < region.grid.size(); ++cell) {
    region.open[cell] = isInsideSolid(region.grid.centreX(cell), region.grid.centreY(cell)) ? 0 : 1;
  }
  region.standable = region.open;
  return region;
}

double threadNanoseconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) * 1e9 + static_cast<double>(now.tv_nsec);
}

std::map<std::string, double>& results() {
  static std::map<std::string, double> kept;
  return kept;
}

}  // namespace

double castRay(double x, double y, double angle) {
  const Point from{x, y};
  const Point direction{std::cos(angle), std::sin(angle)};
  const Box walls{-kLength / 2, kLength / 2, -kWidth / 2, kWidth / 2};
  double nearest = crossBox(walls, from, direction)[1];
  for (const Box& goal : kGoals) {
    const auto [enter, leave] = crossBox(goal, from, direction);
    if (enter <= leave && enter > 0.0) nearest = std::min(nearest, enter);
  }
  for (const Point& post : kPosts) nearest = std::min(nearest, enterCircle(post, from, direction));
  return nearest;
}

bool isInsideSolid(double x, double y) {
  const auto inGoal = [&](const Box& b) {
    return x >= b.left && x <= b.right && y >= b.bottom && y <= b.top;
  };
  const auto inPost = [&](const Point& p) { return std::hypot(x - p.x, y - p.y) <= kPostRadius; };
  const bool outside = std::abs(x) >= kLength / 2 || std::abs(y) >= kWidth / 2;
  return outside || std::any_of(kGoals.begin(), kGoals.end(), inGoal) ||
         std::any_of(kPosts.begin(), kPosts.end(), inPost);
}

const FieldRegion& fieldRegion() {
  static const FieldRegion region = makeRegion();
  return region;
}

SampleSet spreadCloud(std::size_t n) {
  SampleSet set;
  set.resize(n);
  Random random(kSeed);
  for (std::size_t i = 0; i < n; ++i) {
    double x = 0.0;
    double y = 0.0;
    do {
      x = random.uniform(-kLength / 2, kLength / 2);
      y = random.uniform(-kWidth / 2, kWidth / 2);
    } while (isInsideSolid(x, y));
    set.x[i] = static_cast<float>(x);
    set.y[i] = static_cast<float>(y);
    set.theta[i] = static_cast<float>(random.uniform(-std::numbers::pi, std::numbers::pi));
  }
  return set;
}

SampleSet concentratedCloud(std::size_t n) {
  SampleSet set;
  set.resize(n);
  Random random(kSeed);
  for (std::size_t i = 0; i < n; ++i) {
    set.x[i] = static_cast<float>(kRobot.x + 0.1 * random.gaussian());
    set.y[i] = static_cast<float>(kRobot.y + 0.1 * random.gaussian());
    set.theta[i] = static_cast<float>(kRobot.theta + 0.05 * random.gaussian());
  }
  return set;
}

SampleSet cloud(bool spread, std::size_t n) {
  return spread ? spreadCloud(n) : concentratedCloud(n);
}

std::vector<float> scanAt(const Pose2& pose, int beams) {
  std::vector<float> ranges(static_cast<std::size_t>(beams));
  for (int i = 0; i < beams; ++i) {
    const double angle = pose.theta - std::numbers::pi / 2 + i * kRadiansADegree;
    const double range = castRay(pose.x, pose.y, angle);
    ranges[static_cast<std::size_t>(i)] =
        range < kMaxRange ? static_cast<float>(range) : std::numeric_limits<float>::infinity();
  }
  return ranges;
}

std::unique_ptr<ScanData> learnedScan(ScanData::Perception perception, double headingStepDegrees,
                                      const FieldRegion& region) {
  ScanData::Config config;
  config.beams = kBeams;
  config.firstAngle = -std::numbers::pi / 2;
  config.angleStep = kRadiansADegree;
  config.maxRange = kMaxRange;
  config.perception = perception;
  config.endPointCell = kCell;
  auto scan = std::make_unique<ScanData>(SensorId{"Bench", "LRF", "Scan"}, Pose2{}, config);
  std::vector<std::uint32_t> words;
  scan->beginLearning(region, headingStepDegrees * kRadiansADegree);
  const int views = static_cast<int>(std::lround(2 * std::numbers::pi / scan->headingSpacing()));
  for (std::size_t cell = 0; cell < region.grid.size(); ++cell) {
    if (region.open[cell] == 0) continue;
    for (int view = 0; view < views; ++view) {
      const Pose2 pose{region.grid.centreX(cell), region.grid.centreY(cell),
                       wrapAngle(view * scan->headingSpacing())};
      ScanData::encode(scanAt(pose), kMaxRange, words);
      scan->setData(0, words);
      scan->learnProbability(pose);
    }
  }
  scan->endLearning();
  ScanData::encode(scanAt(kRobot), kMaxRange, words);
  scan->setData(1, words);
  return scan;
}

Stopwatch::Stopwatch() : start_(threadNanoseconds()) {}

double Stopwatch::nanoseconds() const { return threadNanoseconds() - start_; }

void remember(const std::string& name, double nanoseconds) { results()[name] = nanoseconds; }

std::optional<double> recall(const std::string& name) {
  const auto it = results().find(name);
  return it == results().end() ? std::nullopt : std::optional(it->second);
}

}  // namespace ortung::bench
