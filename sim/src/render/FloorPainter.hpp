#pragma once

#include <array>
#include <vector>

#include "FaceView.hpp"
#include "GlContext.hpp"
#include "StandingScene.hpp"

namespace ortung {

/// Draws the floor and the lines on it. @pre its context is current, whenever it is used
class FloorPainter {
 public:
  FloorPainter(const GlFunctions& gl, const StandingScene& scene);

  /// @pre a program of the floor is in use
  void paintFloor() const;
  /// @pre a program of lines is in use
  void paintLines(const FaceView& face, const std::array<double, 3>& camera);

 private:
  const GlFunctions& gl_;
  const StandingScene& scene_;
  GLuint floor_ = 0;  ///< vertex array of the floor
  GLuint lines_ = 0;
  GLsizei floorVertices_ = 0;
  GLuint indexBuffer_ = 0;
  std::vector<std::uint32_t> indices_;  ///< indices of the lines that a face sees
};

}  // namespace ortung
