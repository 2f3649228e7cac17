#pragma once

#include <string>

#include "ortung/tables/FieldModel.hpp"
#include "ortung/tables/FieldRegion.hpp"

/// Parts of the report's map, as SVG in the field's metres.
namespace ortung::app {

/// A rectangle of the field and sizes that go with it.
struct MapFrame {
  double left = 0.0;   ///< [m]
  double low = 0.0;    ///< [m]
  double width = 0.0;  ///< [m]
  double height = 0.0;
  double letter = 0.0;  ///< height of letters [m]

  explicit MapFrame(const FieldGrid& grid);
  double right() const { return left + width; }
  double high() const { return low + height; }
};

/// The picture's outline with room for the axes, as viewBox has it: y runs downwards.
std::string viewBox(const MapFrame& frame);
/// Solid and tight cells, with the colours that the page gives to them. y runs downwards.
std::string regionSvg(const FieldRegion& region, const MapFrame& frame);
/// Grid lines, numbers and names of both axes, and a bar of a round length. y runs downwards.
std::string axesSvg(const MapFrame& frame);
/// What is painted on the floor. y runs upwards.
std::string linesSvg(const FieldModel& field);
/// Landmarks with their names for the pointer and for readers of screens. y runs upwards.
std::string landmarksSvg(const FieldModel& field, const MapFrame& frame);

}  // namespace ortung::app
