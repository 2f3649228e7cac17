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

  /// Paint the floor around the field, and what is behind all floor, to the zenith.
  /// @pre a program of the floor is in use
  void paintGround() const;
  void paintHorizon() const;
  /// @pre a program of lines is in use
  void paintLines(const FaceView& face, const std::array<double, 3>& camera);

 private:
  void paint(GLint first, GLsizei count) const;

  const GlFunctions& gl_;
  const StandingScene& scene_;
  GLuint floor_ = 0;  ///< vertex array of the floor
  GLuint lines_ = 0;
  GLuint indexBuffer_ = 0;
  std::vector<std::uint32_t> indices_;  ///< indices of the lines that a face sees
};

}  // namespace ortung
