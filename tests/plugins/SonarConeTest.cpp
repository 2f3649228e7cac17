#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "Files.hpp"
#include "SensorRig.hpp"
#include "ortung/formats/ConeData.hpp"
#include "ortung/sim/SimWorld.hpp"

/// What is within a sonar's cone is seen, however small: poles and boxes by closed forms, bodies of
/// any shape by looking at very many points of their surfaces, posts of maps.
namespace ortung {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;  // [rad]
constexpr double kHalf = 10.0 * kDegree;              // of the cone
constexpr double kZ = 0.25;                           // of the sonar [m]
constexpr double kFine = 0.0012;  // words round to the nearest mm, round outlines are of chords [m]

constexpr const char* kSonar =
    "angles_deg = [0]\nring_radius_m = 0\nopening_deg = 20\nmax_range_m = 5\nnoise_sigma_m = 0\n"
    "noise_sigma_per_m = 0\npose = { z_m = 0.25 }";

std::unique_ptr<SimWorld> worldOf(const std::string& bodies) {
  const test::TemporaryFolder folder;
  test::writeBytes(folder / "world.toml", "[world]\nx_m = [-8, 8]\ny_m = [-8, 8]\n" + bodies);
  return readWorld(folder / "world.toml");
}

/// Far behind the sonar, for worlds without anything else.
constexpr const char* kAside = "[[rectangle]]\ncenter_m = [-7.5, 0]\nsize_m = [0.5, 0.5]\n";

std::string box(double x, double y, double sizeX, double sizeY, double zLow, double zHigh) {
  const auto text = [](double v) { return std::to_string(v); };
  return "[[rectangle]]\ncenter_m = [" + text(x) + ", " + text(y) + "]\nsize_m = [" + text(sizeX) +
         ", " + text(sizeY) + "]\nz_m = [" + text(zLow) + ", " + text(zHigh) + "]\n";
}

/// A sonar at the origin.
struct Sonar {
  /// @param hasNoise whether it fires as in a run with noise (here of zero) or as for tables
  double at(const World& world, double heading, bool hasNoise) {
    Random noise(1);
    rig.sense(world, {0, 0, heading}, hasNoise ? &noise : nullptr);
    return rig.get<ConeData>().reading();
  }
  SensorRig rig{"sonar", kSonar};
};

TEST(SonarCone, SeesAThinPoleInAllBearings) {
  constexpr double kRadius = 0.01;
  Sonar sonar;
  for (const double away : {0.3, 0.5, 1.0, 2.0, 3.0, 4.0}) {
    const auto world = worldOf("[[ellipse]]\ncenter_m = [" + std::to_string(away) +
                               ", 0]\nsize_m = [0.02, 0.02]\nz_m = [0, 1]\n");
    for (double heading = -15.0 * kDegree; heading < 15.0 * kDegree; heading += 0.26 * kDegree) {
      // The nearest point lies on the way to the middle, or where the cone's edge cuts the pole.
      const double beside = std::abs(heading) - kHalf;
      double expected = away - kRadius;
      if (beside > 0.0) {
        const double across = away * std::sin(beside);
        if (std::abs(across - kRadius) < 0.0005) continue;  // the chords' rounding decides
        expected = across > kRadius
                       ? std::numeric_limits<double>::infinity()
                       : away * std::cos(beside) - std::sqrt(kRadius * kRadius - across * across);
      }
      for (const bool hasNoise : {true, false}) {
        const double range = sonar.at(*world, heading, hasNoise);
        if (std::isinf(expected))
          EXPECT_TRUE(std::isinf(range)) << away << " m, " << heading / kDegree << " degrees";
        else
          EXPECT_NEAR(range, expected, kFine) << away << " m, " << heading / kDegree << " degrees";
      }
    }
  }
}

TEST(SonarCone, SeesBoxesAsHighAsItReaches) {
  Sonar sonar;
  struct Case {
    double front, depth, zLow, zHigh, expected;
  };
  const double infinite = std::numeric_limits<double>::infinity();
  const double reach = 0.15 / std::tan(kHalf);  // where the cone meets what is 0.1 m high
  const Case cases[] = {
      {3.0, 0.3, 0.0, 0.1, std::hypot(3.0, 0.15)},    // its upper edge, below the axis
      {0.5, 1.0, 0.0, 0.1, std::hypot(reach, 0.15)},  // further back on its upper side
      {0.5, 0.2, 0.0, 0.1, infinite},                 // the cone passes over it
      {2.0, 0.3, 0.0, 0.5, 2.0},                      // as high as the sonar: its front
      {2.0, 0.3, 0.4, 0.5, std::hypot(2.0, 0.15)},    // hangs above
      {0.5, 0.2, 0.4, 0.5, infinite},
  };
  for (const Case& one : cases) {
    const auto world = worldOf(
        kAside + box(one.front + one.depth / 2.0, 0.0, one.depth, 0.6, one.zLow, one.zHigh));
    for (const bool hasNoise : {true, false}) {
      const double range = sonar.at(*world, 0.0, hasNoise);
      if (std::isinf(one.expected))
        EXPECT_TRUE(std::isinf(range)) << one.front << " " << one.depth << ": " << range;
      else
        EXPECT_NEAR(range, one.expected, kFine) << one.front << " " << one.depth;
    }
  }
}

/// Nearest of very many points of a body's surface that lie within the cone.
double nearestPoint(const Primitive& body, double heading) {
  constexpr int kSteps = 160;
  double nearest = std::numeric_limits<double>::infinity();
  const std::vector<Point2> corners = cornersOf(body);
  const auto look = [&](double x, double y, double z) {
    const double ahead = x * std::cos(heading) + y * std::sin(heading);
    const double range = std::sqrt(x * x + y * y + (z - kZ) * (z - kZ));
    if (ahead >= range * std::cos(kHalf)) nearest = std::min(nearest, range);
  };
  for (int i = 0; i <= kSteps; ++i)
    for (int k = 0; k <= kSteps; ++k) {
      const double u = static_cast<double>(i) / kSteps;
      const double v = static_cast<double>(k) / kSteps;
      double x = 0.0;
      double y = 0.0;
      if (body.shape == Primitive::Shape::kEllipse) {
        const double t = 2.0 * std::numbers::pi * v;
        const double own[] = {u * body.halfX * std::cos(t), u * body.halfY * std::sin(t)};
        x = body.centre.x + own[0] * std::cos(body.angle) - own[1] * std::sin(body.angle);
        y = body.centre.y + own[0] * std::sin(body.angle) + own[1] * std::cos(body.angle);
      } else {
        const Point2& a = corners[0];
        const Point2& b = corners[1];
        const Point2& c = corners.size() == 4 ? corners[3] : corners[2];
        if (corners.size() == 3 && u + v > 1.0) continue;
        x = a.x + u * (b.x - a.x) + v * (c.x - a.x);
        y = a.y + u * (b.y - a.y) + v * (c.y - a.y);
      }
      for (const double z : {body.zLow, body.zHigh, std::clamp(kZ, body.zLow, body.zHigh)})
        look(x, y, z);
    }
  return nearest;
}

TEST(SonarCone, SeesTheNearestPointOfBodiesOfAnyShape) {
  const auto world = worldOf(kAside);
  Random random(3);
  Sonar sonar;
  int seen = 0;
  for (int i = 0; i < 60; ++i) {
    Primitive body;
    body.shape = i % 3 == 0   ? Primitive::Shape::kEllipse
                 : i % 3 == 1 ? Primitive::Shape::kRectangle
                              : Primitive::Shape::kTriangle;
    body.centre = {random.uniform(0.8, 3.0), random.uniform(-0.8, 0.8)};
    body.halfX = random.uniform(0.02, 0.5);
    body.halfY = random.uniform(0.02, 0.5);
    body.angle = random.uniform(-3.0, 3.0);
    body.zLow = random.uniform(0.0, 0.4);
    body.zHigh = body.zLow + random.uniform(0.02, 0.3);
    if (body.shape == Primitive::Shape::kTriangle) {
      for (std::size_t k = 0; k < 3; ++k) {
        const double t = body.angle + 2.0 * std::numbers::pi / 3.0 * static_cast<double>(k);
        body.corners[k] = {body.centre.x + body.halfX * std::cos(t),
                           body.centre.y + body.halfX * std::sin(t)};
      }
      body.angle = 0.0;
    }
    const RobotNumber number = world->addBody({"obstacle", "", "", {body}}, {});
    const double heading = random.uniform(-0.3, 0.3);
    const double expected = nearestPoint(body, heading);
    const double range = sonar.at(*world, heading, true);
    // Points of the grid are at most 6 mm apart, so the nearest is a little nearer than they.
    if (std::isfinite(expected)) {
      ++seen;
      EXPECT_LE(range, expected + kFine) << i;
      EXPECT_GE(range, expected - 0.03) << i;
    } else if (std::isfinite(range)) {
      ADD_FAILURE() << i << " is seen at " << range << " m, but no point of it is in the cone";
    }
    world->removeBody(number);
  }
  EXPECT_GT(seen, 20);
}

/// The smallest thing in a map is a cell.
TEST(SonarCone, SeesASingleCellOfAMapInAllBearings) {
  constexpr int kSize = 200;  // cells of 5 cm: 10 x 10 m
  const test::TemporaryFolder folder;
  Sonar sonar;
  for (const int away : {10, 40, 80}) {  // cells
    std::string map = "P5\n200 200\n255\n" + std::string(kSize * kSize, '\xFE');
    map[map.size() - kSize * kSize + 100 * kSize + 100 + static_cast<std::size_t>(away)] = 0;
    test::writeBytes(folder / "map.pgm", map);
    test::writeBytes(folder / "map.yaml",
                     "image: map.pgm\nresolution: 0.05\norigin: [-5.025, -4.975, 0]\nnegate: 0\n"
                     "occupied_thresh: 0.65\nfree_thresh: 0.196\n");
    test::writeBytes(folder / "world.toml",
                     "[world]\nx_m = [-5, 5]\ny_m = [-5, 5]\n[[grid]]\nmap = \"map.yaml\"\n");
    const auto world = readWorld(folder / "world.toml");
    for (double heading = -9.5 * kDegree; heading < 9.5 * kDegree; heading += 0.26 * kDegree)
      for (const bool hasNoise : {true, false})
        EXPECT_NEAR(sonar.at(*world, heading, hasNoise), 0.05 * away, 0.05)
            << away << " cells, " << heading / kDegree << " degrees";
  }
}

/// A map of this name in which one thing stands, 5 cm thick; gives its table of a world file.
std::string mapOf(const test::TemporaryFolder& folder, const std::string& name, double away,
                  double width, const std::string& heights) {
  std::string image = "P5\n120 100\n255\n" + std::string(120 * 100, '\xFE');
  const auto cells = static_cast<int>(std::lround(width / 0.05));
  for (int row = 50 - (cells + 1) / 2; row < 50 + cells / 2; ++row)
    image[image.size() - 120 * 100 + static_cast<std::size_t>(120 * row) + 20 +
          static_cast<std::size_t>(std::lround(away / 0.05))] = 0;
  test::writeBytes(folder / (name + ".pgm"), image);
  test::writeBytes(folder / (name + ".yaml"),
                   "image: " + name + ".pgm\nresolution: 0.05\norigin: [-1, -2.5, 0]\n");
  return "[[grid]]\nmap = \"" + name + ".yaml\"\nz_m = " + heights + "\n";
}

TEST(SonarCone, SeesWhatHangsAboveItAndThinPostsInWhateverOrderMapsAre) {
  const test::TemporaryFolder folder;
  Sonar sonar;
  const auto range = [&](const std::string& maps, double heading) {
    test::writeBytes(folder / "world.toml", maps);
    return sonar.at(*readWorld(folder / "world.toml"), heading, false);
  };
  const std::string post = mapOf(folder, "post", 3.0, 0.05, "[0, 0.35]");
  const std::string near = mapOf(folder, "near", 1.5, 0.4, "[0.38, 1]");
  const std::string far = mapOf(folder, "far", 4.0, 0.4, "[0.38, 1]");
  for (const std::string& maps : {post + near, near + post, near})
    EXPECT_NEAR(range(maps, 0.0), std::hypot(1.5, 0.38 - kZ), 0.02);
  for (const std::string& maps : {post + far, far + post, post})
    for (double heading = -9.0 * kDegree; heading < 9.0 * kDegree; heading += 0.7 * kDegree)
      EXPECT_NEAR(range(maps, heading), 3.0, 0.05) << heading / kDegree << "\n" << maps;
}

TEST(SonarCone, TellsFalseEchoesAnywhereBeforeTheTrueOne) {
  const auto world = worldOf(box(2.5, 0.0, 1.0, 4.0, 0.0, 1.0));
  for (const double share : {0.0, 0.3, 1.0}) {
    SensorRig rig("sonar", std::string(kSonar) +
                               "\nmin_range_m = 0.2\nfalse_share = " + std::to_string(share));
    Random noise(6);
    constexpr int kDraws = 4000;
    Statistics early;
    for (int i = 0; i < kDraws; ++i) {
      rig.sense(*world, {}, &noise);
      const double range = rig.get<ConeData>().reading();
      if (range < 1.999) early.add(range);
    }
    EXPECT_NEAR(early.count() / static_cast<double>(kDraws), share, 0.03);  // 4 sigma of the draws
    if (share == 0.0) continue;
    EXPECT_NEAR(early.mean(), 1.1, 0.06);  // evenly from 0.2 to 2 m
    EXPECT_NEAR(early.sigma(), 1.8 / std::sqrt(12.0), 0.05);
  }
}

}  // namespace
}  // namespace ortung
