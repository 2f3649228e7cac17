#include "StandingScene.hpp"

#include <algorithm>
#include <cmath>

#include "LineMesh.hpp"
#include "Mesh.hpp"
#include "ortung/sim_api/Colour.hpp"

namespace ortung {
namespace {

constexpr double kChunk = 8.0;  ///< edge length of the squares into which walls are grouped [m]
constexpr Rgba kWallGrey{200, 200, 195, 255};
constexpr double kBandShare = 0.25;  ///< share of a robot's height that shows its team

PixelClass classOf(const std::string& kind) {
  if (kind == "goal") return PixelClass::kGoal;
  if (kind == "post") return PixelClass::kPost;
  if (kind == "ball") return PixelClass::kBall;
  if (kind == "robot") return PixelClass::kRobot;
  if (kind == "wall") return PixelClass::kWall;
  return PixelClass::kObstacle;
}

Rgba usualColour(PixelClass kind) {
  switch (kind) {
    case PixelClass::kGoal:
      return {245, 245, 245, 255};
    case PixelClass::kBall:
      return {255, 140, 20, 255};
    case PixelClass::kRobot:
      return {50, 50, 54, 255};
    case PixelClass::kWall:
      return kWallGrey;
    default:
      return {150, 130, 110, 255};
  }
}

/// Places a unit shape: the columns of the matrix are the images of its axes.
void place(const WorldPiece& piece, const Pose2& object, Instance& instance) {
  if (piece.shape == WorldPiece::Shape::kTriangle) {
    std::array<FloorPoint, 3> c = piece.corners;
    const auto twiceArea = [&] {
      return (c[1].x - c[0].x) * (c[2].y - c[0].y) - (c[2].x - c[0].x) * (c[1].y - c[0].y);
    };
    if (twiceArea() < 0.0) std::swap(c[1], c[2]);  // otherwise its faces would point inwards
    const double cos = std::cos(object.theta);
    const double sin = std::sin(object.theta);
    const auto turned = [&](double x, double y) {
      return FloorPoint{cos * x - sin * y, sin * x + cos * y};
    };
    const FloorPoint a = turned(c[1].x - c[0].x, c[1].y - c[0].y);
    const FloorPoint b = turned(c[2].x - c[0].x, c[2].y - c[0].y);
    const FloorPoint o = turned(c[0].x, c[0].y);
    instance.shape = UnitShape::kPrism;
    instance.matrix = {a.x, b.x, a.y, b.y};
    instance.x = object.x + o.x;
    instance.y = object.y + o.y;
    instance.reach = std::max(std::hypot(a.x, a.y), std::hypot(b.x, b.y));
    return;
  }
  const Pose2 pose = object * piece.pose;
  const double cos = std::cos(pose.theta);
  const double sin = std::sin(pose.theta);
  instance.matrix = {cos * piece.halfX, -sin * piece.halfY, sin * piece.halfX, cos * piece.halfY};
  instance.x = pose.x;
  instance.y = pose.y;
  const bool isRound = piece.shape == WorldPiece::Shape::kEllipse;
  instance.shape = isRound ? UnitShape::kCylinder : UnitShape::kBox;
  instance.reach =
      isRound ? 1.01 * std::max(piece.halfX, piece.halfY) : std::hypot(piece.halfX, piece.halfY);
}

/// Adds the triangles of a map's walls, grouped by location.
void addWalls(const WorldModel& world, StandingScene& scene) {
  WorldModel maps;
  maps.bounds = world.bounds;
  maps.grids = world.grids;
  const Mesh mesh = makeMesh(maps);
  struct Face {
    std::array<WallVertex, 3> corners;
    long long column = 0, row = 0;
  };
  std::vector<Face> faces;
  const auto take = [&](const Triangles& triangles) {
    for (const auto& corners : triangles.corners) {
      Face face;
      std::array<std::array<float, 3>, 3> p;
      for (std::size_t i = 0; i < 3; ++i) p[i] = triangles.vertices[corners[i]];
      std::array<float, 3> u, v;
      for (std::size_t i = 0; i < 3; ++i) {
        u[i] = p[1][i] - p[0][i];
        v[i] = p[2][i] - p[0][i];
      }
      std::array<float, 3> n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                             u[0] * v[1] - u[1] * v[0]};
      const float length = std::max(std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]), 1e-12F);
      for (float& one : n) one /= length;
      for (std::size_t i = 0; i < 3; ++i) face.corners[i] = {p[i], n};
      face.column = std::llround((p[0][0] + p[1][0] + p[2][0]) / 3.0 / kChunk);
      face.row = std::llround((p[0][1] + p[1][1] + p[2][1]) / 3.0 / kChunk);
      faces.push_back(face);
    }
  };
  take(mesh.walls);
  take(mesh.caps);
  std::stable_sort(faces.begin(), faces.end(), [](const Face& a, const Face& b) {
    return std::tie(a.column, a.row) < std::tie(b.column, b.row);
  });
  for (std::size_t i = 0; i < faces.size();) {
    std::size_t end = i;
    std::array<float, 3> low{1e9F, 1e9F, 1e9F}, high{-1e9F, -1e9F, -1e9F};
    Chunk chunk;
    chunk.first = static_cast<std::uint32_t>(scene.walls.size());
    for (; end < faces.size() && faces[end].column == faces[i].column &&
           faces[end].row == faces[i].row;
         ++end)
      for (const WallVertex& corner : faces[end].corners) {
        for (std::size_t k = 0; k < 3; ++k) {
          low[k] = std::min(low[k], corner.place[k]);
          high[k] = std::max(high[k], corner.place[k]);
        }
        scene.walls.push_back(corner);
      }
    chunk.count = static_cast<std::uint32_t>(scene.walls.size()) - chunk.first;
    chunk.x = 0.5 * (low[0] + high[0]);
    chunk.y = 0.5 * (low[1] + high[1]);
    chunk.z = 0.5 * (low[2] + high[2]);
    chunk.reach = 0.5 * std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
    scene.wallChunks.push_back(chunk);
    i = end;
  }
}

}  // namespace

Rgba rgbaOf(const std::string& colour, Rgba fallback) {
  const std::optional<std::uint32_t> rgb = rgbOf(colour);
  if (!rgb) return fallback;
  return {static_cast<std::uint8_t>(*rgb >> 16), static_cast<std::uint8_t>(*rgb >> 8),
          static_cast<std::uint8_t>(*rgb), 255};
}

void addInstances(const WorldObject& object, std::size_t number, std::vector<Instance>& instances) {
  const PixelClass kind = classOf(object.kind);
  const Rgba colour = rgbaOf(object.colour, usualColour(kind));
  for (const WorldPiece& piece : object.pieces) {
    Instance& one = instances.emplace_back();
    place(piece, object.pose, one);
    if (kind == PixelClass::kBall && one.shape == UnitShape::kCylinder)
      one.shape = UnitShape::kBall;
    one.zLow = piece.zLow;
    one.zHigh = piece.zHigh;
    one.reach = std::hypot(one.reach, 0.5 * (piece.zHigh - piece.zLow));
    one.colour = rgbaOf(piece.colour, colour);
    one.isNet = object.isNet;
    one.thing = static_cast<std::uint32_t>(kind) | static_cast<std::uint32_t>(number + 1) << 8;
    if (object.team.empty() || piece.zHigh < object.zHigh) continue;
    one.band = rgbaOf(object.team, {255, 0, 255, 255});
    const double share =
        kBandShare * (object.zHigh - object.zLow) / std::max(piece.zHigh - piece.zLow, 1e-3);
    one.band[3] = static_cast<std::uint8_t>(255.0 * std::min(share, 1.0));
  }
}

StandingScene standingScene(const WorldModel& world, std::span<const WorldObject> objects) {
  StandingScene scene;
  const Box2& b = world.bounds;
  scene.middle = {0.5 * (b.xLow + b.xHigh), 0.5 * (b.yLow + b.yHigh)};
  scene.field = {b.xLow - scene.middle.x, b.xHigh - scene.middle.x, b.yLow - scene.middle.y,
                 b.yHigh - scene.middle.y};
  const std::vector<FieldLine> lines = linesOf(world);
  scene.isPitch = !lines.empty();
  LineMesh mesh(scene);
  for (const FieldLine& line : lines) mesh.add(line);
  for (std::size_t i = 0; i < objects.size(); ++i) addInstances(objects[i], i, scene.instances);
  if (!world.grids.empty()) addWalls(world, scene);
  return scene;
}

}  // namespace ortung
