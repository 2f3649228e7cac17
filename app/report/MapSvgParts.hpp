#pragma once

#include <string>

#include "ortung/mcl/MapChanges.hpp"
#include "ortung/tables/FieldModel.hpp"
#include "ortung/tables/FieldRegion.hpp"

/// Parts of the report's map, as SVG in the field's metres.
namespace ortung::app {

/// The rectangle of the field that a map shows, and the size of its letters.
struct MapFrame {
  double left = 0.0;    ///< x coordinate of the left end [m]
  double low = 0.0;     ///< y coordinate of the lower end [m]
  double width = 0.0;   ///< width [m]
  double height = 0.0;  ///< height [m]
  double letter = 0.0;  ///< height of letters [m]

  explicit MapFrame(const FieldGrid& grid);
  double right() const { return left + width; }
  double high() const { return low + height; }
};

/// Returns the viewBox of the picture, with room for the axes: y points down.
std::string viewBox(const MapFrame& frame);
/// Draws solid and tight cells, in colours of the page. y points down.
std::string regionSvg(const FieldRegion& region, const MapFrame& frame);
/// Draws grid lines, numbers and names of both axes, and a bar of a round length. y points down.
std::string axesSvg(const MapFrame& frame);
/// Draws the painted lines. y points up.
std::string linesSvg(const FieldModel& field);
/// Draws cells where the map no longer fits for sure. y points up.
std::string changesSvg(const MapChanges& changes);
/// Draws landmarks, with names for the pointer and for screen readers. y points up.
std::string landmarksSvg(const FieldModel& field, const MapFrame& frame);

}  // namespace ortung::app
