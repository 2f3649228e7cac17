// Occupancy grids. The first byte says of which format the rest is: 'p' PNG with mended checksums,
// 'r' any image as it is, 'c' CARMEN map, 'z' a packed one, 'y' map_server YAML, 'm' such a YAML up
// to the first line "---", then its image.
#include <cmath>

#include "BoundedFile.hpp"
#include "Fuzz.hpp"
#include "GridMap.hpp"
#include "MapImage.hpp"
#include "MapServerCells.hpp"
#include "MendedFiles.hpp"

namespace {

using namespace ortung;

std::size_t cellsOf(int columns, int rows) {
  return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
}

void decode(const std::string& bytes) {
  MapServerCells cells;
  const MapImage image = decodeImage("image", bytes, [&](const MapPixel& pixel) {
    fuzz::require(pixel.colours <= 3 * MapPixel::kFull && pixel.alpha <= MapPixel::kFull);
    for (const auto mode : {MapServerCells::Mode::kTrinary, MapServerCells::Mode::kScale,
                            MapServerCells::Mode::kRaw}) {
      cells.mode = mode;
      const int occupancy = cells.occupancyOf(pixel);
      fuzz::require(occupancy >= -1 && occupancy <= 100);
    }
    return std::uint8_t{1};
  });
  const std::size_t n = cellsOf(image.width, image.height);
  fuzz::require(n > 0 && image.meanings == std::vector<std::uint8_t>(n, 1));
}

/// What lies straight and what lies in the field are one to one.
void checkPlaces(const GridMap& map) {
  constexpr double kFarthest = 1e4;  // [m]
  const Box2 box = map.bounds();
  for (const double edge : {box.xLow, box.xHigh, box.yLow, box.yHigh})
    fuzz::require(std::abs(edge) <= kFarthest);
  const Point2 corner{map.originX + map.columns * map.cell, map.originY + map.rows * map.cell};
  const Point2 again = map.toGrid(map.toField(corner));
  fuzz::require(std::hypot(again.x - corner.x, again.y - corner.y) < 1e-6);
}

void readMap(const std::string& name) {
  GridMap map = readGridMap(fuzz::folder() / name);
  fuzz::require(!map.cells.empty() && map.cells.size() == cellsOf(map.columns, map.rows));
  checkPlaces(map);
  if (map.cells.size() > 10'000) return;
  markUnknownNearFree(map, 2.0 * map.cell);
  distanceToOccupied(map);
}

void read(char format, std::string rest) {
  if (format == 'p') test::mendPng(rest);
  if (format == 'p' || format == 'r') return decode(rest);
  if (format == 'c' || format == 'z') {
    const std::string name = format == 'c' ? "a.map" : "a.map.gz";
    fuzz::write(name, rest);
    return readMap(name);
  }
  const std::string mark = "\n---\n";
  const std::size_t end = format == 'm' ? rest.find(mark) : rest.npos;
  fuzz::write("a.pgm", end == rest.npos ? "P5 3 1 255\n" + std::string("\xfe\0\xcd", 3)
                                        : rest.substr(end + mark.size()));
  fuzz::write("a.yaml", rest.substr(0, end));
  readMap("a.yaml");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  if (size == 0) return 0;
  fuzz::refusedOrDone<MapError>([&] {
    read(static_cast<char>(bytes[0]), {reinterpret_cast<const char*>(bytes) + 1, size - 1});
  });
  return 0;
}
