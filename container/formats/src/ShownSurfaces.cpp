#include "ShownSurfaces.hpp"

#include "ortung/base/Widest.hpp"

namespace ortung {
namespace {

constexpr double kGrazes = 0.2;  ///< least sine between a beam and a line that it crosses
/// Greatest distance between where a beam crosses a line and the mean of its cell's ends [cells].
constexpr double kWithin = 1.0;
/// Least distance between a line that is crossed and the surface near the end, in standard
/// deviations of both. Robots' maps have one wall in several rows of cells, the foremost of which
/// is no better than the others. From 1.5 to 3, errors on ten logs differ by less than 1 mm.
constexpr double kApart = 2.5;

/// A grid as loops over places need it.
struct GridFrame {
  double x;  ///< of its origin [m]
  double y;
  double perCell;  ///< [1/m]
  double columns;
  double rows;
};

/// Finds the cells of places on beams. Cells of places that are outside, or behind the sensor, have
/// the column -1.
struct BeamCells {
  ORTUNG_INLINE static void run(const BeamRows* beams, GridFrame grid, double back,
                                std::int32_t* columns, std::int32_t* rows) {
    const double x = (beams->sensorX - grid.x) * grid.perCell;
    const double y = (beams->sensorY - grid.y) * grid.perCell;
    const bool isEnd = back == 0.0;
    for (std::size_t i = 0; i < beams->size; ++i) {
      const double at = beams->range[i] * grid.perCell - back;
      const double column = x + at * beams->c[i];
      const double row = y + at * beams->s[i];
      const int isInside = static_cast<int>(column >= 0.0) & static_cast<int>(row >= 0.0) &
                           static_cast<int>(column < grid.columns) &
                           static_cast<int>(row < grid.rows) &
                           (static_cast<int>(isEnd) | static_cast<int>(at > 0.0));
      columns[i] = static_cast<std::int32_t>(isInside != 0 ? column : -1.0);
      rows[i] = static_cast<std::int32_t>(isInside != 0 ? row : 0.0);
    }
  }
};

/// Lets beams show the surfaces whose lines they cross well before those that they showed so far.
struct CrossedSurfaces {
  /// @param before numbers of the surfaces @param shown numbers so far, which change
  ORTUNG_INLINE static void run(const BeamRows* beams, const Surface* surfaces, double within,
                                const std::int32_t* before, std::int32_t* shown) {
    const double x = beams->sensorX;
    const double y = beams->sensorY;
    for (std::size_t i = 0; i < beams->size; ++i) {
      const double c = beams->c[i];
      const double s = beams->s[i];
      const Surface& surface = surfaces[before[i] < 0 ? 0 : before[i]];
      const Surface& last = surfaces[shown[i] < 0 ? 0 : shown[i]];
      const auto nx = static_cast<double>(surface.normalX);
      const auto ny = static_cast<double>(surface.normalY);
      const double dx = static_cast<double>(surface.x) - x;
      const double dy = static_cast<double>(surface.y) - y;
      const double slant = nx * c + ny * s;
      const double squared = slant * slant;
      // The range at which the line is crossed times the slant, so that nothing is divided.
      const double range = nx * dx + ny * dy;
      const double offX = range * c - dx * slant;
      const double offY = range * s - dy * slant;
      const double behind = nx * static_cast<double>(last.x - surface.x) +
                            ny * static_cast<double>(last.y - surface.y);
      const auto blur =
          static_cast<double>(surface.across * surface.across + last.across * last.across);
      const int crosses = static_cast<int>(surface.along < 0.0F) &
                          static_cast<int>(squared >= kGrazes * kGrazes) &
                          static_cast<int>(range * slant < beams->range[i] * squared) &
                          static_cast<int>(offX * offX + offY * offY < within * within * squared) &
                          static_cast<int>(behind * slant > 0.0) &
                          static_cast<int>(behind * behind > kApart * kApart * blur) &
                          static_cast<int>(before[i] >= 0);
      shown[i] = crosses != 0 ? before[i] : shown[i];
    }
  }
};

}  // namespace

void ShownSurfaces::find(const BeamRows& beams) {
  lookUp(beams);
  for (std::size_t k = 1; k < kPlaces; ++k)
    runWidest<CrossedSurfaces>(&beams, surfaces_.surfaces().data(), kWithin * surfaces_.grid().cell,
                               numbers_[k].data(), numbers_[0].data());
}

void ShownSurfaces::lookUp(const BeamRows& beams) {
  const FieldGrid& grid = surfaces_.grid();
  const GridFrame frame{grid.originX, grid.originY, 1.0 / grid.cell,
                        static_cast<double>(grid.columns), static_cast<double>(grid.rows)};
  for (std::size_t k = 0; k < kPlaces; ++k)
    runWidest<BeamCells>(&beams, frame, static_cast<double>(k * kStep), columns_[k].data(),
                         rows_[k].data());
  for (std::size_t i = 0; i < beams.size; ++i) {
    std::int32_t last = 0;
    for (std::size_t k = 0; k < kPlaces; ++k) {
      if (last >= 0)
        last = columns_[k][i] < 0 ? -1 : surfaces_.numberAt(columns_[k][i], rows_[k][i]);
      numbers_[k][i] = last;
    }
  }
}

}  // namespace ortung
