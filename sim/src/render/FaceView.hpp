#pragma once

#include <array>
#include <cmath>

#include "ortung/sim_api/Drawing.hpp"

namespace ortung {

/// The view of a face of a drawing. Positions are relative to the camera, with the field's axes.
class FaceView {
 public:
  FaceView(const CameraPose& camera, const SheetFace& face) {
    // Rows: the face's axes in the field frame.
    for (std::size_t row = 0; row < 3; ++row)
      for (std::size_t column = 0; column < 3; ++column)
        for (std::size_t k = 0; k < 3; ++k)
          toFace_[3 * row + column] += face.inCamera[3 * k + row] * camera.axes[3 * column + k];
    const std::array<std::array<double, 3>, 4> sides{{{1.0, 0.0, -face.left},
                                                      {-1.0, 0.0, face.right},
                                                      {0.0, 1.0, -face.top},
                                                      {0.0, -1.0, face.bottom}}};
    for (std::size_t i = 0; i < 4; ++i) {
      const double length = std::sqrt(1.0 + sides[i][2] * sides[i][2]);
      for (std::size_t column = 0; column < 3; ++column)
        inward_[i][column] = (sides[i][0] * toFace_[column] + sides[i][1] * toFace_[3 + column] +
                              sides[i][2] * toFace_[6 + column]) /
                             length;
    }
  }

  /// Returns whether any part of a sphere may be visible.
  bool sees(double x, double y, double z, double reach) const {
    if (toFace_[6] * x + toFace_[7] * y + toFace_[8] * z < -reach) return false;
    for (const auto& n : inward_)
      if (n[0] * x + n[1] * y + n[2] * z < -reach) return false;
    return true;
  }

  /// Returns a direction of the face's frame in the field frame.
  std::array<double, 3> direction(double x, double y, double z) const {
    return {toFace_[0] * x + toFace_[3] * y + toFace_[6] * z,
            toFace_[1] * x + toFace_[4] * y + toFace_[7] * z,
            toFace_[2] * x + toFace_[5] * y + toFace_[8] * z};
  }

  /// Returns the projection matrix for OpenGL, column by column. The first row of pixels is the top
  /// one.
  std::array<float, 16> toClip(const SheetFace& face, double near, double far) const {
    const double sx = 2.0 / (face.right - face.left);
    const double sy = 2.0 / (face.bottom - face.top);
    const double cx = (face.right + face.left) / (face.right - face.left);
    const double cy = (face.bottom + face.top) / (face.bottom - face.top);
    const double sz = (far + near) / (far - near);
    std::array<float, 16> m{};
    for (std::size_t column = 0; column < 3; ++column) {
      const double x = toFace_[column], y = toFace_[3 + column], z = toFace_[6 + column];
      m[4 * column] = static_cast<float>(sx * x - cx * z);
      m[4 * column + 1] = static_cast<float>(sy * y - cy * z);
      m[4 * column + 2] = static_cast<float>(sz * z);
      m[4 * column + 3] = static_cast<float>(z);
    }
    m[14] = static_cast<float>(-2.0 * far * near / (far - near));
    return m;
  }

 private:
  std::array<double, 9> toFace_{};                 ///< rows: the face's axes in the field frame
  std::array<std::array<double, 3>, 4> inward_{};  ///< inward normals of the sides of the view
};

}  // namespace ortung
