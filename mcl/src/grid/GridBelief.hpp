#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/base/PoseCovariance.hpp"
#include "ortung/mcl/SampleSet.hpp"
#include "ortung/tables/FieldRegion.hpp"

namespace ortung {

/// A belief as probabilities (shares) of the cells of a grid of (x, y, heading). The cells of one
/// heading are a layer. Each layer has an offset of a fraction of a cell, so that motion without
/// noise does not blur the belief. Motion noise does, by steps to neighbouring cells that have its
/// mean and covariance. Not thread-safe.
class ORTUNG_API GridBelief {
 public:
  /// @param area area that the grid covers
  /// @param cell edge of a cell [m]
  /// @param turns number of headings per turn, at least 4
  GridBelief(const FieldGrid& area, double cell, int turns);

  static std::size_t cellsOf(const FieldGrid& area, double cell, int turns);
  int columns() const { return columns_; }
  int rows() const { return rows_; }

  /// Sets the share of each cell by its centre, up to a common factor. @returns false if all shares
  /// are zero
  bool fill(const std::function<double(const Pose2&)>& shareAt);
  /// Moves the belief by a change of pose in the robot's frame. Shares that leave the area are
  /// lost.
  void move(const Pose2& change);
  /// Adds noise of mean zero in the frame of the robot as it was before @p turn [rad].
  /// @param covariance row-major, of (x [m], y [m], theta [rad])
  void blur(const PoseCovariance& covariance, double turn);
  /// Multiplies each share by e^v and normalizes; very small shares become zero. @param logOf
  /// computes v of each cell, in the order of samples()
  void weigh(const std::function<void(const SampleSet& cells, std::vector<float>& out)>& logOf);
  /// Returns the centres of all cells with a share above zero; their log weights are ln of the
  /// shares, which sum to 1.
  SampleSet samples() const;

  /// Visits all cells with a share above zero. @param visit (centre, share)
  void forEach(const std::function<void(const Pose2&, double)>& visit) const;
  double cell() const { return cell_; }
  double headingStep() const { return step_; }

 private:
  struct Box {
    int firstRow, rows, firstColumn, columns;
  };
  /// Offset of a layer from its cells' nominal positions, at most half a cell [m].
  struct Offset {
    double x = 0.0;
    double y = 0.0;
  };
  double headingOf(int turn) const;
  std::size_t placeOf(int turn, int row, int column) const {
    return static_cast<std::size_t>((turn + firstLayer_) % turns_) * layerSize() +
           static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }
  float* layer(std::vector<float>& of, int turn) const { return of.data() + placeOf(turn, 0, 0); }
  /// Visits the rows of the bounding box in layers with shares above zero. @param visit (turn, row,
  /// shares)
  template <class Grid, class Visit>
  static void forEachRow(Grid& grid, const Visit& visit);
  std::size_t layerSize() const {
    return static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
  }
  void grow(int by);
  void take(int grownBy, std::vector<std::uint8_t> filled);
  void normalize();
  void addShifted(const float* from, double right, double up, float share, float* to) const;
  void turnAbout(float share, const Offset& aside, double turn);
  void spread(int right, int up, const std::vector<float>& shareOfLayer);

  FieldGrid area_;
  double cell_;
  int turns_;
  double step_;  ///< angle between headings [rad]
  int columns_;
  int rows_;
  double turnOffset_ = 0.0;  ///< common offset of all headings, at most half a step [rad]
  std::vector<Offset> offsets_;
  /// Layer of heading 0; turning changes it without moving memory.
  int firstLayer_ = 0;
  std::vector<float> shares_;           ///< shares by (layer, row, column)
  std::vector<float> buffer_;           ///< scratch memory in the same order; zeros
  std::vector<std::uint8_t> isFilled_;  ///< whether a layer has any share
  Box box_;  ///< bounding box of all layers; outside, all shares are zero
};

}  // namespace ortung
