#pragma once

#include "Picture.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/tables/FieldModel.hpp"
#include "ortung/tables/FieldRegion.hpp"

namespace ortung::app {

/// Draws in metres of the field within a picture: x to the right, y up, both at one scale.
class FieldCanvas {
 public:
  /// @param left, top where the grid's upper left corner lies [pixels]
  /// @param zoom edge of a cell [pixels]
  FieldCanvas(Picture& picture, const FieldGrid& grid, int left, int top, int zoom);

  double pixelX(double x) const { return left_ + zoom_ * (x - grid_.originX) / grid_.cell; }
  double pixelY(double y) const {
    return top_ + zoom_ * (grid_.rows - (y - grid_.originY) / grid_.cell);
  }
  int width() const { return grid_.columns * zoom_; }  ///< of the field [pixels]
  int height() const { return grid_.rows * zoom_; }

  /// Ticks with metres left of the field and below it, and the names of the axes.
  void axes() const;
  /// What is painted on the floor, and landmarks.
  void field(const FieldModel& model) const;
  /// Marks that leave free what lies in their middle.
  void truth(const Pose2& pose) const;
  void best(double x, double y) const;

  // Marks as a legend shows them, with their middle there [pixels].
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
