#include "MapWalls.hpp"

#include <algorithm>
#include <array>
#include <bit>

#include "ortung/base/StraightPieces.hpp"

namespace ortung {
namespace {

constexpr double kShortest = 0.3;  // [m]
constexpr std::size_t kMostWalls = 4096;
constexpr double kRaggedCells =
    1.2;  // how far a drawn wall may deviate from a straight line [cells]

/// Directions of an outline, which goes along the edge of an occupied cell with the free cell on
/// its left. They are in the order of left turns.
enum Way : std::uint8_t { kEast, kNorth, kWest, kSouth, kWays };
constexpr std::array<int, kWays> kColumns = {1, 0, -1, 0};
constexpr std::array<int, kWays> kRows = {0, 1, 0, -1};

/// Follows the edges between occupied and free cells.
class Outlines {
 public:
  explicit Outlines(const GridMap& map)
      : map_(map),
        isLeft_(static_cast<std::size_t>(map.columns + 1) * static_cast<std::size_t>(map.rows + 1),
                0) {
    for (int row = 0; row <= map.rows; ++row)
      for (int column = 0; column <= map.columns; ++column)
        for (int way = 0; way < kWays; ++way)
          if (isEdge(column, row, way)) at(column, row) |= bit(way);
  }

  /// Calls found with the middles of the edges of each outline. One that is open, since it ends at
  /// unknown cells, has to be followed from its beginning, or it falls to pieces; what is left then
  /// is closed and may be followed from anywhere.
  template <class Found>
  void forEach(const Found& found) {
    for (const bool isAnywhere : {false, true})
      for (int row = 0; row <= map_.rows; ++row)
        for (int column = 0; column <= map_.columns; ++column)
          while (at(column, row) != 0 && (isAnywhere || isBeginning(column, row)))
            found(follow(column, row));
  }

 private:
  static std::uint8_t bit(int way) { return static_cast<std::uint8_t>(1U << way); }
  std::uint8_t& at(int column, int row) {
    return isLeft_[static_cast<std::size_t>(row) * static_cast<std::size_t>(map_.columns + 1) +
                   static_cast<std::size_t>(column)];
  }
  bool is(int column, int row, bool occupied) const {
    if (column < 0 || row < 0 || column >= map_.columns || row >= map_.rows) return false;
    const GridCell cell = map_.at(column, row);
    return occupied ? cell == GridCell::kOccupied
                    : cell == GridCell::kFree || cell == GridCell::kUnknownNearFree;
  }
  /// Returns whether the edge from a corner has a free cell on its left and an occupied one on its
  /// right.
  bool isEdge(int column, int row, int way) const {
    constexpr std::array<int, kWays> kLeftColumn = {0, -1, -1, 0};
    constexpr std::array<int, kWays> kLeftRow = {0, 0, -1, -1};
    const auto left = static_cast<std::size_t>(way);
    const auto right = static_cast<std::size_t>((way + kWays - 1) % kWays);
    return is(column + kLeftColumn[left], row + kLeftRow[left], false) &&
           is(column + kLeftColumn[right], row + kLeftRow[right], true);
  }

  /// Returns whether more edges leave a corner than come to it.
  bool isBeginning(int column, int row) {
    int more = std::popcount(at(column, row));
    for (int way = 0; way < kWays; ++way) {
      const int fromColumn = column - kColumns[static_cast<std::size_t>(way)];
      const int fromRow = row - kRows[static_cast<std::size_t>(way)];
      if (fromColumn < 0 || fromRow < 0 || fromColumn > map_.columns || fromRow > map_.rows)
        continue;
      more -= (at(fromColumn, fromRow) & bit(way)) != 0 ? 1 : 0;
    }
    return more > 0;
  }

  std::vector<PlanePoint> follow(int column, int row) {
    std::vector<PlanePoint> points;
    const int firstColumn = column;
    const int firstRow = row;
    int way = 0;
    while (at(column, row) != 0) {
      // Where two outlines touch, turning left keeps them separate.
      for (const int turn : {1, 0, 3, 2}) {
        const int next = (way + turn) % kWays;
        if ((at(column, row) & bit(next)) == 0) continue;
        way = next;
        break;
      }
      at(column, row) = static_cast<std::uint8_t>(at(column, row) & ~bit(way));
      const auto w = static_cast<std::size_t>(way);
      points.push_back({map_.originX + (column + 0.5 * kColumns[w]) * map_.cell,
                        map_.originY + (row + 0.5 * kRows[w]) * map_.cell});
      column += kColumns[w];
      row += kRows[w];
    }
    if (column == firstColumn && row == firstRow) beginAtACorner(points);
    return points;
  }

  /// Rotates a closed outline so that it does not begin in the middle of a wall: the point that is
  /// farthest from the mean is a corner.
  static void beginAtACorner(std::vector<PlanePoint>& points) {
    PlanePoint mean;
    for (const PlanePoint& p : points) {
      mean.x += p.x / static_cast<double>(points.size());
      mean.y += p.y / static_cast<double>(points.size());
    }
    const auto isNearer = [&](const PlanePoint& a, const PlanePoint& b) {
      return distance(a, mean) < distance(b, mean);
    };
    std::rotate(points.begin(), std::max_element(points.begin(), points.end(), isNearer),
                points.end());
  }

  const GridMap& map_;
  /// Directions, as bits, of the edges left to follow at each corner of cells.
  std::vector<std::uint8_t> isLeft_;
};

}  // namespace

void addMapWalls(const GridBody& body, std::vector<FieldWall>& walls) {
  const StraightPiecesConfig config{
      .tolerance = kRaggedCells * body.map.cell, .shortest = kShortest, .fewestPoints = 3};
  std::vector<FieldWall> found;
  Outlines(body.map).forEach([&](const std::vector<PlanePoint>& outline) {
    for (const StraightPiece& piece : straightPiecesOf(outline, config)) {
      // Rays end behind the outline, so the wall as it is seen is there.
      const double length = distance(piece.from, piece.to);
      const double x = body.surfaceDepth * (piece.to.y - piece.from.y) / length;
      const double y = -body.surfaceDepth * (piece.to.x - piece.from.x) / length;
      found.push_back({piece.from.x + x, piece.from.y + y, piece.to.x + x, piece.to.y + y,
                       body.zLow, body.zHigh, false});
    }
  });
  std::stable_sort(found.begin(), found.end(), [](const FieldWall& a, const FieldWall& b) {
    return lengthOf(a) > lengthOf(b);
  });
  if (found.size() > kMostWalls) found.resize(kMostWalls);
  for (const FieldWall& wall : found) {
    const Point2 from = body.map.toField({wall.x0, wall.y0});
    const Point2 to = body.map.toField({wall.x1, wall.y1});
    walls.push_back({from.x, from.y, to.x, to.y, wall.zLow, wall.zHigh, wall.ofGoal});
  }
}

}  // namespace ortung
