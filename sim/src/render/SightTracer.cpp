#include "SightTracer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "StandingScene.hpp"
#include "TriangleScene.hpp"
#include "ortung/base/Angles.hpp"

namespace ortung {
namespace {

constexpr float kFarthest = 4000.0F;  ///< how far cameras see [m]
constexpr std::size_t kBatch = 512;   ///< rays that are followed together, within a cache
constexpr std::uint32_t kNone = ~0U;  ///< number of no triangle
constexpr float kNowhere = std::numeric_limits<float>::infinity();
constexpr float kInto = 1.0F + 1e-5F;      ///< a ray ends a little below the floor
constexpr float kBelow = 1e-4F;            ///< depth to which it ends below it at least [m]
constexpr std::size_t kRoundCorners = 40;  ///< number of corners of a spot

/// Triangles, and the word of Traced::things that each of them stands for.
struct Soup {
  std::vector<FloatVector> corners;
  std::vector<std::uint32_t> things;

  void add(const FloatVector& a, const FloatVector& b, const FloatVector& c, std::uint32_t thing) {
    corners.insert(corners.end(), {a, b, c});
    things.push_back(thing);
  }

  void add(const Instance& one, const UnitMesh& mesh, const Point2& middle) {
    if (one.isNet) return;
    const auto shape = static_cast<std::size_t>(one.shape);
    const auto begin = mesh.corners.begin() + mesh.first[shape];
    std::for_each(begin, begin + mesh.count[shape], [&](std::uint16_t corner) {
      const auto& [x, y, z] = mesh.vertices[corner].place;
      corners.push_back(
          {static_cast<float>(one.matrix[0] * x + one.matrix[1] * y + one.x - middle.x),
           static_cast<float>(one.matrix[2] * x + one.matrix[3] * y + one.y - middle.y),
           static_cast<float>(one.zLow + z * (one.zHigh - one.zLow))});
    });
    things.resize(corners.size() / 3, one.thing);
  }
};

/// The lines' own outlines, without what drawing adds to smooth their edges.
Soup outlinesOf(const StandingScene& scene) {
  constexpr auto kLine = static_cast<std::uint32_t>(PixelClass::kLine);
  Soup soup;
  for (const Chunk& piece : scene.lineChunks) {
    const std::span<const LineVertex> four(scene.lines.data() + piece.first, 4);
    if (const LineVertex& spot = four[0]; spot.half < 0.0F) {
      const auto corner = [&](std::size_t i) {
        const double angle = kTurn * static_cast<double>(i) / kRoundCorners;
        return FloatVector{spot.x - spot.half * static_cast<float>(std::cos(angle)),
                           spot.y - spot.half * static_cast<float>(std::sin(angle)), 0.0F};
      };
      for (std::size_t i = 0; i < kRoundCorners; ++i)
        soup.add({spot.x, spot.y, 0.0F}, corner(i), corner(i + 1), kLine);
      continue;
    }
    std::array<FloatVector, 4> c;
    for (std::size_t i = 0; i < 4; ++i) {
      const float across = four[i].side * four[i].half;
      c[i] = {four[i].x + across * four[i].acrossX, four[i].y + across * four[i].acrossY, 0.0F};
    }
    soup.add(c[0], c[1], c[2], kLine);
    soup.add(c[0], c[2], c[3], kLine);
  }
  return soup;
}

/// Bodies that do not move, and the walls of maps.
Soup solidsOf(const StandingScene& scene, const UnitMesh& mesh) {
  Soup soup;
  for (const Instance& one : scene.instances) soup.add(one, mesh, scene.middle);
  for (const WallVertex& corner : scene.walls) soup.corners.push_back(corner.place);
  soup.things.resize(soup.corners.size() / 3, static_cast<std::uint32_t>(PixelClass::kWall));
  return soup;
}

/// What does not move, ready for rays.
struct Standing {
  explicit Standing(const StandingScene& scene)
      : middle(scene.middle),
        field(scene.field),
        fixed(solidsOf(scene, mesh)),
        solids(device, fixed.corners),
        lines(device, outlinesOf(scene).corners) {}

  UnitMesh mesh = unitMesh();
  Point2 middle;
  Box2 field;  ///< bounds of the field relative to the middle
  TriangleDevice device;
  Soup fixed;
  TriangleScene solids;
  TriangleScene lines;

  std::uint32_t floorAt(float x, float y) const {
    const bool isField = x >= field.xLow && x <= field.xHigh && y >= field.yLow && y <= field.yHigh;
    return static_cast<std::uint32_t>(isField ? PixelClass::kField : PixelClass::kBackground);
  }
};

/// Some rays on their way.
struct Batch {
  std::array<FloatVector, kBatch> rays;    ///< directions in the field frame
  std::array<float, kBatch> floor;         ///< distance to the floor, or how far cameras see [m]
  std::array<float, kBatch> ranges;        ///< what each ray has met so far [m]
  std::array<std::uint32_t, kBatch> hits;  ///< triangle that it meets
  std::array<std::uint32_t, kBatch> things;

  /// Turns rays into the field frame and lets them meet the floor.
  void begin(const CameraPose& camera, std::span<const std::array<float, 3>> directions) {
    std::array<float, 9> axes;
    std::transform(camera.axes.begin(), camera.axes.end(), axes.begin(),
                   [](double value) { return static_cast<float>(value); });
    const auto height = static_cast<float>(camera.position[2]);
    for (std::size_t i = 0; i < directions.size(); ++i) {
      const auto& [x, y, z] = directions[i];
      for (std::size_t k = 0; k < 3; ++k)
        rays[i][k] = axes[3 * k] * x + axes[3 * k + 1] * y + axes[3 * k + 2] * z;
      const bool isSeen = x != 0.0F || y != 0.0F || z != 0.0F;
      const float down = -height / rays[i][2];
      floor[i] = !isSeen ? 0.0F : down > 0.0F && down < kFarthest ? down : kFarthest;
      ranges[i] = floor[i];
      things[i] = kNone;
    }
  }

  /// Lets the rays meet triangles, before which nothing was met nearer.
  void meet(const TriangleScene& scene, const Soup& soup, const FloatVector& origin,
            std::size_t count) {
    hits.fill(kNone);
    scene.meet(origin, std::span(rays).first(count), std::span(ranges).first(count),
               std::span(hits).first(count));
    for (std::size_t i = 0; i < count; ++i)
      if (hits[i] != kNone) things[i] = soup.things[hits[i]];
  }

  /// Tells what the rays that met nothing else show of the floor.
  void paint(const Standing& ground, const FloatVector& origin, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      const bool isFloor = things[i] == kNone && floor[i] > 0.0F && floor[i] < kFarthest;
      ranges[i] = things[i] != kNone || isFloor ? ranges[i] : kNowhere;
      floor[i] = isFloor ? floor[i] * kInto + kBelow : 0.0F;
      if (things[i] != kNone) continue;
      things[i] = isFloor ? ground.floorAt(origin[0] + ranges[i] * rays[i][0],
                                           origin[1] + ranges[i] * rays[i][1])
                          : static_cast<std::uint32_t>(PixelClass::kBackground);
    }
    hits.fill(kNone);
    ground.lines.meet(origin, std::span(rays).first(count), std::span(floor).first(count),
                      std::span(hits).first(count));
    for (std::size_t i = 0; i < count; ++i)
      if (hits[i] != kNone) things[i] = static_cast<std::uint32_t>(PixelClass::kLine);
  }
};

}  // namespace

struct SightTracer::Ground : Standing {
  using Standing::Standing;
};

SightTracer::SightTracer() = default;
SightTracer::~SightTracer() = default;

const SightTracer::Ground& SightTracer::ground(const WorldModel& world,
                                               std::span<const WorldObject> standing) {
  const std::lock_guard lock(mutex_);
  if (!ground_) ground_ = std::make_unique<const Ground>(standingScene(world, standing));
  return *ground_;
}

void SightTracer::trace(const WorldModel& world, std::span<const WorldObject> objects,
                        std::size_t standing, const Sight& sight, const Traced& traced) {
  if (traced.things.size() != sight.rays.size() || traced.ranges.size() != sight.rays.size())
    throw std::invalid_argument(std::to_string(sight.rays.size()) + " rays, but room for " +
                                std::to_string(traced.things.size()) + " things and " +
                                std::to_string(traced.ranges.size()) + " ranges");
  const Ground& ground = this->ground(world, objects.first(standing));
  std::vector<Instance> instances;
  for (std::size_t i = standing; i < objects.size(); ++i)
    if (sight.ignore == 0 || objects[i].robot != sight.ignore)
      addInstances(objects[i], i, instances);
  Soup moving;
  for (const Instance& one : instances) moving.add(one, ground.mesh, ground.middle);
  const TriangleScene movers(ground.device, moving.corners);

  const std::array<double, 3>& camera = sight.camera.position;
  const FloatVector origin{static_cast<float>(camera[0] - ground.middle.x),
                           static_cast<float>(camera[1] - ground.middle.y),
                           static_cast<float>(camera[2])};
  Batch batch;
  for (std::size_t first = 0; first < sight.rays.size(); first += kBatch) {
    const std::size_t count = std::min(kBatch, sight.rays.size() - first);
    batch.begin(sight.camera, sight.rays.subspan(first, count));
    batch.meet(ground.solids, ground.fixed, origin, count);
    batch.meet(movers, moving, origin, count);
    batch.paint(ground, origin, count);
    std::copy_n(batch.things.begin(), count, traced.things.subspan(first).begin());
    std::copy_n(batch.ranges.begin(), count, traced.ranges.subspan(first).begin());
  }
}

}  // namespace ortung
