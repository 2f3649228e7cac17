#pragma once

#include <optional>
#include <string>
#include <vector>

#include "Picture.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/tables/FieldModel.hpp"
#include "ortung/tables/FieldRegion.hpp"

namespace ortung::app {

/// Values over the field (paper, Fig. 7): the darker, the greater.
struct HeatMap {
  const FieldRegion* region = nullptr;
  std::vector<double> values;  ///< one a cell; NaN: none
  std::string caption;
  std::string note;                   ///< a second line: how the values were made; may be ""
  std::string quantity;               ///< what the values are; may be ""
  std::string unit;                   ///< of the values; may be ""
  bool logarithmic = false;           ///< even in the values' logarithms; values are not negative
  const FieldModel* field = nullptr;  ///< lines and landmarks to draw; may be null
  std::optional<Pose2> truth;         ///< marked with a ring
  bool marksBest = false;             ///< the cell of the greatest value gets a square

  struct Scale {
    double low = 0.0;   ///< pale: this and all below
    double high = 0.0;  ///< dark: the greatest value
  };
  /// Ends of the scale: the least and greatest value of open cells. A logarithmic one begins where
  /// a twentieth of the cells lie below, so that a few hopeless ones don't flatten all others.
  /// Equal, or (0, 0), where there are no others.
  Scale scale() const;
  /// Values at @p count even steps of colour from pale to dark.
  std::vector<double> legend(int count) const;
  /// The open cell with the greatest value; nothing without values.
  std::optional<std::size_t> best() const;
  /// Whether an even scale would show next to nothing: less than a fiftieth of the cells with a
  /// value reach a tenth of the greatest one.
  bool isPeaked() const;
};

/// Scaled up to about 800 pixels, both axes alike, with axes, outlines of all that is solid,
/// caption and legend.
Picture draw(const HeatMap& map);

}  // namespace ortung::app
