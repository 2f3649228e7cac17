#pragma once

#include "GlContext.hpp"
#include "ortung/sim_api/Drawing.hpp"

namespace ortung {

/// The buffers into which OpenGL draws: colours, or things and ranges, and depths.
/// @pre its context is current, whenever it is used
class GlSheet {
 public:
  explicit GlSheet(const GlFunctions& gl);

  /// Enlarges the buffers to at least this size. @throws std::runtime_error if there is no memory
  void resize(int width, int height);
  void beginColours(const Rgb& background);
  void readColours(int width, int height, std::uint32_t* out);
  void beginThings();
  void readThings(int width, int height, const Sheet& sheet);

 private:
  enum Buffer { kColours, kThings, kRanges, kDepths, kBuffers };

  const GlFunctions& gl_;
  GLuint buffers_[kBuffers] = {};
  GLuint forColours_ = 0;
  GLuint forThings_ = 0;
  int width_ = 0;
  int height_ = 0;
};

}  // namespace ortung
