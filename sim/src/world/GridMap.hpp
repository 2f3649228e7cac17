#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "ortung/sim/Primitive.hpp"

namespace ortung {

inline constexpr std::size_t kMaxGridCells = std::size_t{1} << 26;

/// A map file that cannot be read; the message begins with the file's name.
class MapError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

enum class GridCell : std::uint8_t {
  kFree,
  kUnknownNearFree,  ///< unknown, but so near to a free cell that robots and sensors may be there
  kUnknown,
  kOccupied
};

/// An occupancy grid. As long as it is not turned, cell (column, row) begins at originX + column *
/// cell and originY + row * cell; row 0 is at the bottom. All of it is turned about its lower left
/// corner: places are computed for the map as if it lay straight, and toField() and toGrid() are
/// the only way between these and the field.
struct GridMap {
  int columns = 0;
  int rows = 0;
  double cell = 0.05;           ///< edge length of a cell [m]
  double originX = 0.0;         ///< x of the lower left corner [m]
  double originY = 0.0;         ///< y of the lower left corner [m]
  std::vector<GridCell> cells;  ///< cells, row by row
  double yaw = 0.0;             ///< direction of its rows in the field [rad]; set by turnTo()
  double cosine = 1.0;          ///< of yaw
  double sine = 0.0;            ///< of yaw

  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(column);
  }
  GridCell at(int column, int row) const { return cells[index(column, row)]; }

  /// Lets the rows run in a direction [rad]; within 1e-9 of a whole turn, the map lies straight.
  void turnTo(double direction);
  bool isTurned() const { return yaw != 0.0; }
  /// Returns where a place of the map that lies straight is in the field [m].
  Point2 toField(const Point2& straight) const;
  /// Returns where a place of the field would be if the map lay straight [m].
  Point2 toGrid(const Point2& inField) const;
  /// Returns the box in the field around all cells [m].
  Box2 bounds() const;
};

/// A grid as a body of the world, extruded in z.
struct GridBody {
  double surfaceDepth = 0.0;  ///< rays end this far behind the outline of occupied cells [m]
  /// Standard deviation of how far surfaces are from where the map has them, beyond rounding [m].
  double mapError = 0.0;
  GridMap map;
  double zLow = 0.0;   ///< height of its bottom [m]
  double zHigh = 1.0;  ///< height of its top [m]
};

/// Reads an occupancy grid: map_server YAML (.yaml, .yml), CARMEN map (.map, .cmf, .carmen, also
/// with .gz) or MRPT grid map (.gridmap, .gridmap.gz). @throws MapError
GridMap readGridMap(const std::filesystem::path& file);
/// Returns whether a file is such a map, by the ending of its name or its content.
ORTUNG_API bool isGridMap(const std::filesystem::path& file);

// The readers of the single formats. All throw MapError.
GridMap readMapServer(const std::filesystem::path& yaml);
GridMap readCarmenMap(const std::filesystem::path& file);
GridMap readMrptGridMap(const std::filesystem::path& file);

/// Checks size and place of a grid that is not turned. @throws MapError
void checkGrid(const std::filesystem::path& file, double columns, double rows, double cell,
               double originX, double originY);
/// Checks that a grid lies within 10 km of the origin. @throws MapError
void checkPlace(const std::filesystem::path& file, const GridMap& map);

/// Marks unknown cells that are no farther than @p margin from a free one, with only unknown cells
/// between: SLAM maps have unknown spots where the robot itself stood, but what lies behind a wall
/// stays unknown.
void markUnknownNearFree(GridMap& map, double margin);

/// Returns the exact distance from the centre of each cell to the centre of the nearest occupied
/// one, in cells; infinity if there is none.
std::vector<float> distanceToOccupied(const GridMap& map);

}  // namespace ortung
