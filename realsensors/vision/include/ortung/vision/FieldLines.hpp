#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/tables/FieldModel.hpp"

namespace ortung {

/// A point on the floor [m]; functions that take one say in which frame.
struct LinePlace {
  double x = 0.0;
  double y = 0.0;
};

/// The painted lines of a field. Immutable, hence thread-safe.
class ORTUNG_API FieldLines {
 public:
  /// Lines without width are left out.
  /// @throws std::invalid_argument if no line is left, or more than 10000
  explicit FieldLines(std::span<const FieldLine> lines);

  /// The nearest point on the centre line of a painted line.
  struct Nearest {
    double x = 0.0, y = 0.0;  ///< the nearest point in the field frame [m]
    double distance = 0.0;    ///< distance to it [m]; 0 on a filled spot
  };
  /// Returns the nearest point of all lines to a point in the field frame [m].
  Nearest nearest(double x, double y) const;
  /// Returns the nearest point of one line. @param line index into lines()
  Nearest nearestOn(std::size_t line, double x, double y) const;

  /// Bounding box of all lines in the field frame [m].
  double xMin() const { return xMin_; }
  double xMax() const { return xMax_; }
  double yMin() const { return yMin_; }
  double yMax() const { return yMax_; }
  /// The lines, without those that have no width.
  std::span<const FieldLine> lines() const { return lines_; }

 private:
  std::vector<FieldLine> lines_;
  double xMin_ = 0.0, xMax_ = 0.0, yMin_ = 0.0, yMax_ = 0.0;
};

/// A pose at which points on lines fit a field, and how well.
struct LinePose {
  Pose2 pose;         ///< pose of the points' frame in the field frame
  double cost = 0.0;  ///< mean of min((distance / sigma)^2, 9) over the points, in [0, 9]
};

/// Searches the whole field for the poses at which points fit its lines best: an exhaustive grid
/// search by a table of distances, whose best poses are refined. Thread-safe.
class ORTUNG_API LinePoseSearch {
 public:
  struct Config {
    double step = 0.4;     ///< distance between places of the grid [m]
    double turn = 0.0873;  ///< angle between headings of the grid [rad]
    double beyond = 1.0;   ///< how far outside the lines the frame's origin may be [m]
    double cell = 0.05;    ///< cell size of the table of distances [m]
    double blur = 0.2;     ///< sigma added (as variance) to the points' in the grid search [m]
    int usedPoints = 40;   ///< greatest number of points, evenly picked, in the grid search
  };
  /// Computes the table of distances.
  explicit LinePoseSearch(const FieldLines& lines);
  LinePoseSearch(const FieldLines& lines, const Config& config);

  /// Searches the whole field.
  /// @param points points in one frame on the floor [m], size N
  /// @param sigmas standard deviations of their places [m], size N
  /// @param most   greatest number of poses that are returned
  /// @return distinct poses, the best first; empty without points
  std::vector<LinePose> search(std::span<const LinePlace> points, std::span<const double> sigmas,
                               std::size_t most) const;
  /// Refines a pose by Gauss-Newton steps, in which outliers have less and less weight.
  LinePose polish(std::span<const LinePlace> points, std::span<const double> sigmas,
                  const Pose2& start) const;
  /// Returns the cost of one pose, see LinePose.
  double cost(std::span<const LinePlace> points, std::span<const double> sigmas,
              const Pose2& pose) const;
  /// Returns the same as FieldLines::nearest() from the lines near a cell of the table: exact
  /// except where several lines are about equally far.
  FieldLines::Nearest nearest(double x, double y) const;
  /// The lines that are searched.
  const FieldLines& lines() const { return lines_; }

 private:
  struct Picked {  ///< of points: those that the grid is searched with
    std::vector<LinePlace> places;
    std::vector<float> weights;  ///< 1 / sigma^2
  };
  Picked pick(std::span<const LinePlace> points, std::span<const double> sigmas) const;
  class Cheapest;
  /// Offers the poses of all places of the grid at one heading.
  void searchHeading(const Picked& picked, double theta, Cheapest& found) const;
  std::ptrdiff_t cellAt(double x, double y) const;  ///< index of a cell; negative: outside

  FieldLines lines_;
  Config config_;
  double xMin_ = 0.0, yMin_ = 0.0;
  int columns_ = 0, rows_ = 0;
  std::vector<float> distances_;  ///< distance to the nearest line of each cell, row by row [m]
  std::vector<std::uint16_t> nearest_;  ///< index of that line
};

}  // namespace ortung
