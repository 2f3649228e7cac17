#pragma once

#include "GlContext.hpp"
#include "ortung/sim_api/Drawing.hpp"

namespace ortung {

/// The buffers into which OpenGL draws: colours and depths.
/// @pre its context is current, whenever it is used
class GlSheet {
 public:
  explicit GlSheet(const GlFunctions& gl);

  /// Enlarges the buffers to at least this size. @throws std::runtime_error if there is no memory
  void resize(int width, int height);
  /// Fills the sheet with the floor's colour.
  void begin(const Rgb& floor);
  void read(int width, int height, std::uint32_t* out);

 private:
  enum Buffer { kColours, kDepths, kBuffers };

  const GlFunctions& gl_;
  GLuint buffers_[kBuffers] = {};
  GLuint frame_ = 0;
  int width_ = 0;
  int height_ = 0;
};

}  // namespace ortung
