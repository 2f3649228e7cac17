#include "GlSheet.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace ortung {
namespace {

constexpr float kFarthest = 1.0F;

}  // namespace

GlSheet::GlSheet(const GlFunctions& gl) : gl_(gl) {
  gl_.GenRenderbuffers(kBuffers, buffers_);
  gl_.GenFramebuffers(1, &frame_);
}

void GlSheet::resize(int width, int height) {
  if (width <= width_ && height <= height_) return;
  width_ = std::max(width, width_);
  height_ = std::max(height, height_);
  constexpr GLenum kFormats[kBuffers] = {GL_RGBA8, GL_DEPTH_COMPONENT24};
  for (int i = 0; i < kBuffers; ++i) {
    gl_.BindRenderbuffer(GL_RENDERBUFFER, buffers_[i]);
    gl_.RenderbufferStorage(GL_RENDERBUFFER, kFormats[i], width_, height_);
  }
  const auto attach = [&](GLenum where, Buffer what) {
    gl_.FramebufferRenderbuffer(GL_FRAMEBUFFER, where, GL_RENDERBUFFER, buffers_[what]);
  };
  gl_.BindFramebuffer(GL_FRAMEBUFFER, frame_);
  attach(GL_COLOR_ATTACHMENT0, kColours);
  attach(GL_DEPTH_ATTACHMENT, kDepths);
  const bool works = gl_.CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
  if (works && gl_.GetError() == GL_NO_ERROR) return;
  const std::string size = std::to_string(width_) + " x " + std::to_string(height_);
  width_ = height_ = 0;
  throw std::runtime_error("OpenGL has no memory to draw " + size + " pixels into");
}

void GlSheet::begin(const Rgb& floor) {
  gl_.BindFramebuffer(GL_FRAMEBUFFER, frame_);
  const GLfloat colour[4] = {floor[0], floor[1], floor[2], 0.0F};
  gl_.ClearBufferfv(GL_COLOR, 0, colour);
  gl_.ClearBufferfv(GL_DEPTH, 0, &kFarthest);
}

void GlSheet::read(int width, int height, std::uint32_t* out) {
  gl_.ReadBuffer(GL_COLOR_ATTACHMENT0);
  gl_.ReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, out);
}

}  // namespace ortung
