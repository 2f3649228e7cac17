#include "MapServerCells.hpp"

#include <cmath>

namespace ortung {
namespace {

constexpr int kUnknown = -1;
constexpr int kFull = 100;  // [%]

}  // namespace

// Follows nav2_map_server: colours count by their mean, and what is transparent is unknown. Until
// 2025 it took alpha for a fourth colour in trinary mode, by which opaque pixels became lighter.
int MapServerCells::occupancyOf(const MapPixel& pixel) const {
  const double light = pixel.colours / 3.0 / MapPixel::kFull;
  if (mode == Mode::kRaw) {
    const double value = std::round(light * 255.0);
    return value <= kFull ? static_cast<int>(value) : kUnknown;
  }
  if (pixel.alpha != MapPixel::kFull) return kUnknown;
  const double dark = negate ? light : 1.0 - light;
  if (dark > occupiedAbove) return kFull;
  if (dark < freeBelow) return 0;
  if (mode == Mode::kTrinary || !(occupiedAbove > freeBelow)) return kUnknown;
  return static_cast<int>(std::rint((dark - freeBelow) / (occupiedAbove - freeBelow) * kFull));
}

GridCell cellOf(int occupancy) {
  constexpr int kOccupiedFrom = 65;
  constexpr int kFreeTo = 25;
  if (occupancy < 0 || occupancy > kFull) return GridCell::kUnknown;
  if (occupancy >= kOccupiedFrom) return GridCell::kOccupied;
  return occupancy <= kFreeTo ? GridCell::kFree : GridCell::kUnknown;
}

}  // namespace ortung
