#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Time.hpp"
#include "ortung/run/Robot.hpp"

namespace ortung {

/// What a client wants to see of the field.
struct HeatMapWish {
  std::vector<std::string> queries;  ///< "MODEL/TYPE/FEATURE"; none: all features that localize
  std::optional<double> heading;     ///< the robot's heading [rad]; nothing: each cell's best one
  bool isLogarithmic = false;        ///< levels of ln p instead of p
  bool isExpectation = false;        ///< what the feature expects, instead of how probable it is
  std::size_t index = 0;             ///< index of the expected value to show
  std::size_t mostCells = 40'000;    ///< greatest number of cells, at least 1
};

/// A map as a client gets it: a byte a cell, rows from the lowest y on.
struct HeatMap {
  Timestamp stamp = 0;  ///< stamp of the newest reading used [us]
  FieldGrid grid;
  double low = 0.0;          ///< what byte 1 is: p, or [m] or [rad]
  double high = 0.0;         ///< what byte 255 is; between them it is linear
  std::string bytes = {};    ///< a byte per cell; 0: not open, or nothing is expected there
  std::size_t readings = 0;  ///< number of features in a probability; without any p is 1
  std::size_t values = 0;    ///< number of values of the feature, for an expectation
  bool isAngle = false;      ///< whether the expected value is an angle
};

/// How probable the robot's present readings are all over the field, by the code with which MCL
/// weighs, or what one of its features expects.
/// @param goOn asked often; false: nothing comes back
/// @throws ServeError if no feature is wanted that localizes; for an expectation, if there is not
///   just one
ORTUNG_API std::optional<HeatMap> heatMap(const Robot& robot, const HeatMapWish& wish,
                                          const std::function<bool()>& goOn);

/// The same probabilities in both scales, linear first, for little more than one of them takes.
/// @param wish of a probability; its scale does not matter @throws ServeError as heatMap()
ORTUNG_API std::optional<std::pair<HeatMap, HeatMap>> bothHeatMaps(
    const Robot& robot, const HeatMapWish& wish, const std::function<bool()>& goOn);

/// Features of a robot that localize and that one of the queries means.
/// @throws ServeError if there is none, std::invalid_argument for a text that is no query
ORTUNG_API std::vector<const SensorData*> chosenFeatures(const Robot& robot,
                                                         const std::vector<std::string>& queries);

}  // namespace ortung
