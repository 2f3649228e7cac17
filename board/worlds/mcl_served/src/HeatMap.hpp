#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "ortung/base/Time.hpp"
#include "ortung/run/Robot.hpp"

namespace ortung {

/// What a client wants to see of the field.
struct HeatMapWish {
  std::vector<std::string> queries;  ///< "MODEL/TYPE/FEATURE"; none: all features that localize
  std::optional<double> heading;     ///< of the robot [rad]; nothing: the best one for each cell
  bool isLogarithmic = false;        ///< levels of ln p instead of p
  bool isExpectation = false;        ///< what the feature expects, instead of how probable it is
  std::size_t index = 0;             ///< which of its values is expected
  std::size_t mostCells = 40'000;    ///< of the map; at least 1
};

/// A map as a client gets it: a byte a cell, rows from the lowest y on.
struct HeatMap {
  Timestamp stamp = 0;  ///< of the newest reading that counts
  FieldGrid grid;
  double low = 0.0;          ///< what byte 1 is: p, or [m] or [rad]
  double high = 0.0;         ///< what byte 255 is; between them it is linear
  std::string bytes = {};    ///< 0: the cell is not open, or nothing is expected there
  std::size_t readings = 0;  ///< of a probability: how many features count; of none p is 1
  std::size_t values = 0;    ///< of an expectation: how many the feature has
  bool isAngle = false;      ///< of an expectation
};

/// @param goOn asked often; false: nothing comes back
/// @throws ServeError if no feature is wanted that localizes; for an expectation, if there is not
///   just one
std::optional<HeatMap> heatMap(const Robot& robot, const HeatMapWish& wish,
                               const std::function<bool()>& goOn);

/// Features of a robot that localize and that one of the queries means.
/// @throws ServeError if there is none, std::invalid_argument for a text that is no query
std::vector<const SensorData*> chosenFeatures(const Robot& robot,
                                              const std::vector<std::string>& queries);

/// The same field in square cells that are a whole number of its own wide, so that there are
/// @p most at most; one is open where its centre is.
FieldRegion coarsened(const FieldRegion& region, std::size_t most);

}  // namespace ortung
