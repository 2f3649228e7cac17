#include "Mesh.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace ortung {
namespace {

constexpr std::size_t kMaxFaces = std::size_t{1} << 21;

class Builder {
 public:
  explicit Builder(Mesh& mesh) : mesh_(mesh) {}

  void addWall(const Point2& a, const Point2& b, double zLow, double zHigh) {
    addFace({vertex(a, zLow), vertex(b, zLow), vertex(b, zHigh), vertex(a, zHigh)}, mesh_.walls);
  }
  /// Adds a triangle or rectangle as bottom and top, except below the floor, from where nothing
  /// looks up.
  void addCaps(const std::vector<Point2>& corners, double zLow, double zHigh) {
    for (const double z : {zLow, zHigh}) {
      if (z <= 0.0) continue;
      std::vector<std::array<float, 3>> points;
      for (const Point2& corner : corners) points.push_back(vertex(corner, z));
      addFace(points, mesh_.caps);
    }
  }

 private:
  std::array<float, 3> vertex(const Point2& p, double z) const {
    return {static_cast<float>(p.x - mesh_.middle.x), static_cast<float>(p.y - mesh_.middle.y),
            static_cast<float>(z)};
  }
  void addFace(const std::vector<std::array<float, 3>>& corners, Triangles& into) {
    if (++faces_ > kMaxFaces)
      throw std::length_error(
          "the world has more than 2^21 walls, which is too many; is a map all noise?");
    const auto first = static_cast<std::uint32_t>(into.vertices.size());
    into.vertices.insert(into.vertices.end(), corners.begin(), corners.end());
    for (std::uint32_t i = 2; i < corners.size(); ++i)
      into.corners.push_back({first, first + i - 1, first + i});
  }

  Mesh& mesh_;
  std::size_t faces_ = 0;
};

void addPrimitive(const Primitive& primitive, Builder& builder) {
  const std::vector<Point2> corners = cornersOf(primitive);
  for (std::size_t i = 0; i < corners.size(); ++i)
    builder.addWall(corners[i], corners[(i + 1) % corners.size()], primitive.zLow, primitive.zHigh);
  builder.addCaps(corners, primitive.zLow, primitive.zHigh);
}

bool isOccupied(const GridMap& map, int column, int row) {
  return column >= 0 && row >= 0 && column < map.columns && row < map.rows &&
         map.at(column, row) == GridCell::kOccupied;
}

/// Calls found(from, to) for every longest run of i in [0, n) for which isPart(i) holds.
template <class IsPart, class Found>
void forRuns(int n, const IsPart& isPart, const Found& found) {
  int from = -1;
  for (int i = 0; i <= n; ++i) {
    const bool inside = i < n && isPart(i);
    if (inside && from < 0) from = i;
    if (!inside && from >= 0) {
      found(from, i);
      from = -1;
    }
  }
}

// Tops and bottoms of the occupied cells, for rays that rise or fall: one rectangle for each run of
// cells, and one for equal runs in rows that follow each other.
void addCaps(const GridBody& body, Builder& builder) {
  const GridMap& map = body.map;
  const auto rectangle = [&](int from, int to, int low, int high) {
    const double x0 = map.originX + from * map.cell;
    const double x1 = map.originX + to * map.cell;
    const double y0 = map.originY + low * map.cell;
    const double y1 = map.originY + high * map.cell;
    const auto corner = [&](double x, double y) { return map.toField({x, y}); };
    builder.addCaps({corner(x0, y0), corner(x1, y0), corner(x1, y1), corner(x0, y1)}, body.zLow,
                    body.zHigh);
  };
  std::vector<int> begun(static_cast<std::size_t>(map.columns), -1);
  std::vector<int> end(begun.size(),
                       -1);  // end of the run that begins at a column; begun: its first row
  const auto close = [&](int from, int row) {
    const auto i = static_cast<std::size_t>(from);
    if (begun[i] >= 0) rectangle(from, end[i], begun[i], row);
    begun[i] = -1;
  };
  for (int r = 0; r <= map.rows; ++r) {
    std::vector<int> now(begun.size(), -1);
    if (r < map.rows)
      forRuns(
          map.columns, [&](int c) { return map.at(c, r) == GridCell::kOccupied; },
          [&](int from, int to) { now[static_cast<std::size_t>(from)] = to; });
    for (int c = 0; c < map.columns; ++c) {
      const auto i = static_cast<std::size_t>(c);
      if (begun[i] >= 0 && end[i] != now[i]) close(c, r);
      if (now[i] < 0 || begun[i] >= 0) continue;
      begun[i] = r;
      end[i] = now[i];
    }
  }
}

}  // namespace

void forOutline(const GridBody& body,
                const std::function<void(const Point2&, const Point2&)>& found) {
  const GridMap& map = body.map;
  const auto corner = [&](int column, int row) {
    return map.toField({map.originX + column * map.cell, map.originY + row * map.cell});
  };
  for (int c = 0; c <= map.columns; ++c)
    forRuns(
        map.rows, [&](int r) { return isOccupied(map, c - 1, r) != isOccupied(map, c, r); },
        [&](int from, int to) { found(corner(c, from), corner(c, to)); });
  for (int r = 0; r <= map.rows; ++r)
    forRuns(
        map.columns, [&](int c) { return isOccupied(map, c, r - 1) != isOccupied(map, c, r); },
        [&](int from, int to) { found(corner(from, r), corner(to, r)); });
}

Mesh makeMesh(const WorldModel& world) {
  Mesh mesh;
  mesh.middle = {0.5 * (world.bounds.xLow + world.bounds.xHigh),
                 0.5 * (world.bounds.yLow + world.bounds.yHigh)};
  Builder builder(mesh);
  for (const Primitive& primitive : world.primitives) {
    if (!primitive.isSolid()) continue;
    if (primitive.shape == Primitive::Shape::kEllipse)
      mesh.round.push_back({primitive.centre, primitive.halfX, primitive.halfY, primitive.angle,
                            primitive.zLow, primitive.zHigh});
    else
      addPrimitive(primitive, builder);
  }
  const bool anyDepth = std::any_of(world.grids.begin(), world.grids.end(),
                                    [](const GridBody& body) { return body.surfaceDepth > 0.0; });
  for (const GridBody& body : world.grids) {
    if (anyDepth) mesh.depths.push_back({mesh.walls.corners.size(), body.surfaceDepth});
    forOutline(body, [&](const Point2& from, const Point2& to) {
      builder.addWall(from, to, body.zLow, body.zHigh);
    });
    addCaps(body, builder);
  }
  return mesh;
}

}  // namespace ortung
