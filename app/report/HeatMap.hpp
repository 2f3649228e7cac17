#pragma once

#include <optional>
#include <string>
#include <vector>

#include "Picture.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/tables/FieldModel.hpp"
#include "ortung/tables/FieldRegion.hpp"

namespace ortung::app {

/// A picture of values over the field (paper, Fig. 7): the greater, the darker.
struct HeatMap {
  const FieldRegion* region = nullptr;
  std::vector<double> values;  ///< value of each cell; NaN: none
  std::string caption;
  std::string note;                   ///< second line: how the values were made; may be ""
  std::string quantity;               ///< name of the values; may be ""
  std::string unit;                   ///< unit of the values; may be ""
  bool logarithmic = false;           ///< whether the scale is logarithmic, for values >= 0
  const FieldModel* field = nullptr;  ///< lines and landmarks to draw; may be null
  std::optional<Pose2> truth;         ///< true pose, marked with a ring
  bool marksBest = false;             ///< whether the greatest value is marked with a square

  struct Scale {
    double low = 0.0;   ///< value, and all below, with the palest colour
    double high = 0.0;  ///< greatest value, with the darkest colour
  };
  /// Returns the ends of the scale: the least and greatest value of open cells. A logarithmic scale
  /// begins at the 5 % quantile, so that a few very improbable cells do not flatten all others. The
  /// ends are equal, or (0, 0), if there is only one value or none.
  Scale scale() const;
  /// Returns the values of @p count even steps of colour from pale to dark.
  std::vector<double> legend(int count) const;
  /// Returns the open cell with the greatest value; nothing without values.
  std::optional<std::size_t> best() const;
  /// Returns whether a linear scale would show almost nothing: less than 2 % of the cells with a
  /// value reach a tenth of the greatest one.
  bool isPeaked() const;
};

/// Draws a map of about 800 pixels, with axes, outlines of solid cells, caption and legend.
Picture draw(const HeatMap& map);

}  // namespace ortung::app
