#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/tables/FieldModel.hpp"

namespace ortung {

/// A point on the floor [m]; whoever names one names its frame.
struct LinePlace {
  double x = 0.0;
  double y = 0.0;
};

/// Where a field's painted lines are. Immutable, hence thread-safe.
class ORTUNG_API FieldLines {
 public:
  /// @throws std::invalid_argument if there are none
  explicit FieldLines(std::span<const FieldLine> lines);

  /// The nearest point on the middle of a line.
  struct Nearest {
    double x = 0.0, y = 0.0;  ///< it, in the field frame [m]
    double distance = 0.0;    ///< [m]; of what lies on a filled spot 0
  };
  Nearest nearest(double x, double y) const;
  /// The nearest point on the middle of one line. @param line index into lines()
  Nearest nearestOn(std::size_t line, double x, double y) const;

  /// The smallest rectangle that holds all lines [m].
  double xMin() const { return xMin_; }
  double xMax() const { return xMax_; }
  double yMin() const { return yMin_; }
  double yMax() const { return yMax_; }
  std::span<const FieldLine> lines() const { return lines_; }

 private:
  std::vector<FieldLine> lines_;
  double xMin_ = 0.0, xMax_ = 0.0, yMin_ = 0.0, yMax_ = 0.0;
};

/// Poses at which points on lines fit a field.
struct LinePose {
  Pose2 pose;         ///< of the points' frame, in the field frame
  double cost = 0.0;  ///< mean of min((distance / sigma)^2, 9)
};

/// Searches the whole field for the poses at which points fit its lines best: an exhaustive grid
/// over a table of distances, its best places polished. Thread-safe.
class ORTUNG_API LinePoseSearch {
 public:
  struct Config {
    double step = 0.4;     ///< between places [m]
    double turn = 0.0873;  ///< between headings [rad]
    double beyond = 1.0;   ///< how far outside the lines the frame's origin may be [m]
    double cell = 0.05;    ///< of the table of distances [m]
    double blur = 0.2;     ///< added to the points' sigmas while the grid is searched [m]
    int usedPoints = 40;   ///< at most, evenly picked, while the grid is searched
  };
  explicit LinePoseSearch(const FieldLines& lines);
  LinePoseSearch(const FieldLines& lines, const Config& config);

  /// @param points in one frame on the floor [m] @param sigmas of their places [m], as many
  /// @return at most @p most, the best first, no two at one place; none of no points
  std::vector<LinePose> search(std::span<const LinePlace> points, std::span<const double> sigmas,
                               std::size_t most) const;
  /// The nearest best pose by Gauss and Newton's steps, outliers counted less and less.
  LinePose polish(std::span<const LinePlace> points, std::span<const double> sigmas,
                  const Pose2& start) const;
  /// The cost of one pose.
  double cost(std::span<const LinePlace> points, std::span<const double> sigmas,
              const Pose2& pose) const;
  /// As FieldLines::nearest(), but among the lines near a cell of the table only: exact but where
  /// several lines are about equally far.
  FieldLines::Nearest nearest(double x, double y) const;
  const FieldLines& lines() const { return lines_; }

 private:
  struct Picked {  ///< of points: those that the grid is searched with
    std::vector<LinePlace> places;
    std::vector<float> weights;  ///< 1 / sigma^2
  };
  Picked pick(std::span<const LinePlace> points, std::span<const double> sigmas) const;
  /// Adds the costs of all places of the grid at one heading.
  void searchHeading(const Picked& picked, double theta, std::vector<LinePose>& found) const;
  std::ptrdiff_t cellAt(double x, double y) const;  ///< below 0: outside

  FieldLines lines_;
  Config config_;
  double xMin_ = 0.0, yMin_ = 0.0;
  int columns_ = 0, rows_ = 0;
  std::vector<float> distances_;        ///< row by row [m]
  std::vector<std::uint16_t> nearest_;  ///< line
};

}  // namespace ortung
