#pragma once

#include <optional>
#include <string>
#include <vector>

#include "Picture.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/tables/FieldRegion.hpp"

namespace ortung::app {

/// Values over the field (paper, Fig. 7): the darker, the greater.
struct HeatMap {
  const FieldRegion* region = nullptr;
  std::vector<double> values;  ///< one a cell; NaN: none
  std::string caption;
  std::string unit;            ///< of the values; may be ""
  bool logarithmic = false;    ///< grey is even in the values' logarithms; values are positive
  std::optional<Pose2> truth;  ///< marked in red

  struct Scale {
    double low = 0.0;   ///< white
    double high = 0.0;  ///< black
  };
  /// Ends of the scale: the least and greatest value; equal, or (0, 0), where there are no others.
  Scale scale() const;
  /// Values at @p count even steps of grey from white to black.
  std::vector<double> legend(int count) const;
};

/// Scaled up to about 800 pixels, with outlines of all that is solid, caption and legend.
Picture draw(const HeatMap& map);

}  // namespace ortung::app
