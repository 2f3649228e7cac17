#pragma once

#include "GridMap.hpp"
#include "MapImage.hpp"

namespace ortung {

/// What the description of a map_server map says of its pixels.
struct MapServerCells {
  enum class Mode {
    kTrinary,  ///< free, occupied or unknown
    kScale,    ///< between the two thresholds as much occupied as it is dark
    kRaw       ///< the values themselves
  };
  Mode mode = Mode::kTrinary;
  bool negate = false;          ///< whether light pixels are occupied; not in raw mode
  double occupiedAbove = 0.65;  ///< darkness, from 0 to 1
  double freeBelow = 0.196;     ///< darkness, from 0 to 1

  /// Returns what map_server publishes of a pixel, in percent: 0 (free) to 100 (occupied), or -1
  /// (unknown).
  int occupancyOf(const MapPixel& pixel) const;
};

/// Returns the cell that a published occupancy means, as map_server's map_saver has it: from 65 on
/// it is occupied, from 0 to 25 free, anything else unknown.
GridCell cellOf(int occupancy);

}  // namespace ortung
