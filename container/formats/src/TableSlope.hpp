#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <type_traits>

#include "ortung/base/Angles.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/core/Correctable.hpp"
#include "ortung/core/Polishable.hpp"
#include "ortung/tables/PositionTable.hpp"
#include "ortung/tables/SensorModel.hpp"

/// How what tables over the position expect changes with the pose of the robot.
namespace ortung {

/// How probably a reading so many standard deviations off is no outlier.
inline double inlierShare(double outliers, double sigmas) {
  const double inlier = (1.0 - outliers) * std::exp(-0.5 * sigmas * sigmas);
  return inlier / (inlier + outliers);
}

/// Adds what a residual says. @param expectation its derivatives by the robot's x, y, theta
inline void addResidual(Slope& slope, double residual, const std::array<double, 3>& expectation,
                        double sigma, const SensorModel& model) {
  const double weight =
      model.exponent * inlierShare(model.outliers, residual / sigma) / (sigma * sigma);
  if (!std::isfinite(weight)) return;
  for (const double derivative : expectation)
    if (!std::isfinite(derivative)) return;
  slope.add(residual, expectation, weight);
}

/// Derivatives by the robot's x, y, theta of what depends on where the sensor is.
/// @param x, y its derivatives by the sensor's position @param turn how it changes with heading
/// alone
inline std::array<double, 3> byRobot(double x, double y, double turn, const Pose2& robot,
                                     const Pose2& sensor) {
  return {x, y, turn + y * (sensor.x - robot.x) - x * (sensor.y - robot.y)};
}

/// Difference of two expectations of a table: distances, or directions by the shorter way.
template <class Table>
double differenceOf(double a, double b) {
  if constexpr (std::is_same_v<Table, BearingTable>) return wrapAngle(a - b);
  return a - b;
}

/// Derivative of a table along (x, y), which are 0 or 1; NaN: it knows too little there. Over a
/// cell's width, since a table that is interpolated has a kink at each centre of a cell.
template <class Table>
double derivative(const Table& table, const Pose2& sensor, double alongX, double alongY) {
  const double step = 0.5 * table.cells().grid().cell;
  const auto at = [&](double by) {
    return static_cast<double>(table.at(sensor.x + alongX * by, sensor.y + alongY * by));
  };
  const double middle = at(0.0);
  double before = at(-step);
  double after = at(step);
  double width = 2.0 * step;
  if (std::isnan(before) || std::isnan(after)) width = step;
  if (std::isnan(before)) before = middle;
  if (std::isnan(after)) after = middle;
  return differenceOf<Table>(after, before) / width;
}

/// A reading beside what a table expects; nothing where it expects nothing. @param reading [m], or
/// a bearing in the sensor's frame [rad]
template <class Table>
std::optional<ReadingResidual> residualOf(const Table& table, double reading, double sigma,
                                          const SensorModel& model, const Pose2& robot,
                                          const Pose2& sensor) {
  constexpr bool kIsBearing = std::is_same_v<Table, BearingTable>;
  const double expected =
      static_cast<double>(table.at(sensor.x, sensor.y)) - (kIsBearing ? sensor.theta : 0.0);
  if (std::isnan(expected)) return std::nullopt;
  return ReadingResidual{
      kIsBearing,
      differenceOf<Table>(reading, expected),
      expected,
      byRobot(derivative(table, sensor, 1.0, 0.0), derivative(table, sensor, 0.0, 1.0),
              kIsBearing ? -1.0 : 0.0, robot, sensor),
      sigma,
      model.outliers};
}

/// Adds what a reading says of which a table knows what to expect.
template <class Table>
void addReading(Slope& slope, const Table& table, double reading, double sigma,
                const SensorModel& model, const Pose2& robot, const Pose2& sensor) {
  if (const auto residual = residualOf(table, reading, sigma, model, robot, sensor))
    addResidual(slope, residual->value, residual->byPose, sigma, model);
}

}  // namespace ortung
