#pragma once

#include "Picture.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/tables/FieldModel.hpp"
#include "ortung/tables/FieldRegion.hpp"

namespace ortung::app {

/// Draws within a picture in field coordinates [m]: x to the right, y up, both at one scale.
class FieldCanvas {
 public:
  /// @param left, top place of the grid's upper left corner in the picture [px]
  /// @param zoom size of a cell [px]
  FieldCanvas(Picture& picture, const FieldGrid& grid, int left, int top, int zoom);

  double pixelX(double x) const { return left_ + zoom_ * (x - grid_.originX) / grid_.cell; }
  double pixelY(double y) const {
    return top_ + zoom_ * (grid_.rows - (y - grid_.originY) / grid_.cell);
  }
  int width() const { return grid_.columns * zoom_; }  ///< width of the field [px]
  int height() const { return grid_.rows * zoom_; }

  /// Draws ticks with metres left of the field and below it, and the names of the axes.
  void axes() const;
  /// Draws the painted lines and the landmarks.
  void field(const FieldModel& model) const;
  // These draw marks that leave their middle free.
  void truth(const Pose2& pose) const;
  void best(double x, double y) const;

  // These draw marks for a legend, with their middle at (x, y) [px].
  static void drawTruth(Picture& picture, double x, double y, double heading);
  static void drawBest(Picture& picture, double x, double y, double half);
  static void drawLandmark(Picture& picture, double x, double y, int half);

 private:
  void line(const FieldLine& line) const;

  Picture& picture_;
  const FieldGrid& grid_;
  int left_;
  int top_;
  int zoom_;
};

}  // namespace ortung::app
