#include "GlSheet.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

namespace ortung {
namespace {

constexpr float kFarthest = 1.0F;

}  // namespace

GlSheet::GlSheet(const GlFunctions& gl) : gl_(gl) {
  gl_.GenRenderbuffers(kBuffers, buffers_);
  gl_.GenFramebuffers(1, &forColours_);
  gl_.GenFramebuffers(1, &forThings_);
}

void GlSheet::resize(int width, int height) {
  if (width <= width_ && height <= height_) return;
  width_ = std::max(width, width_);
  height_ = std::max(height, height_);
  constexpr GLenum kFormats[kBuffers] = {GL_RGBA8, GL_RGBA8, GL_R32F, GL_DEPTH_COMPONENT24};
  for (int i = 0; i < kBuffers; ++i) {
    gl_.BindRenderbuffer(GL_RENDERBUFFER, buffers_[i]);
    gl_.RenderbufferStorage(GL_RENDERBUFFER, kFormats[i], width_, height_);
  }
  const auto attach = [&](GLenum where, Buffer what) {
    gl_.FramebufferRenderbuffer(GL_FRAMEBUFFER, where, GL_RENDERBUFFER, buffers_[what]);
  };
  gl_.BindFramebuffer(GL_FRAMEBUFFER, forColours_);
  attach(GL_COLOR_ATTACHMENT0, kColours);
  attach(GL_DEPTH_ATTACHMENT, kDepths);
  bool works = gl_.CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
  gl_.BindFramebuffer(GL_FRAMEBUFFER, forThings_);
  attach(GL_COLOR_ATTACHMENT0, kThings);
  attach(GL_COLOR_ATTACHMENT1, kRanges);
  attach(GL_DEPTH_ATTACHMENT, kDepths);
  constexpr GLenum kBoth[2] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
  gl_.DrawBuffers(2, kBoth);
  works = works && gl_.CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
  if (works && gl_.GetError() == GL_NO_ERROR) return;
  const std::string size = std::to_string(width_) + " x " + std::to_string(height_);
  width_ = height_ = 0;
  throw std::runtime_error("OpenGL has no memory to draw " + size + " pixels into");
}

void GlSheet::beginColours(const Rgb& background) {
  gl_.BindFramebuffer(GL_FRAMEBUFFER, forColours_);
  const GLfloat colour[4] = {background[0], background[1], background[2], 1.0F};
  gl_.ClearBufferfv(GL_COLOR, 0, colour);
  gl_.ClearBufferfv(GL_DEPTH, 0, &kFarthest);
}

void GlSheet::readColours(int width, int height, std::uint32_t* out) {
  gl_.ReadBuffer(GL_COLOR_ATTACHMENT0);
  gl_.ReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, out);
}

void GlSheet::beginThings() {
  gl_.BindFramebuffer(GL_FRAMEBUFFER, forThings_);
  constexpr GLfloat kNothing[4] = {0.0F, 0.0F, 0.0F, 0.0F};
  constexpr GLfloat kNowhere[4] = {std::numeric_limits<float>::infinity(), 0.0F, 0.0F, 0.0F};
  gl_.ClearBufferfv(GL_COLOR, 0, kNothing);
  gl_.ClearBufferfv(GL_COLOR, 1, kNowhere);
  gl_.ClearBufferfv(GL_DEPTH, 0, &kFarthest);
}

void GlSheet::readThings(int width, int height, const Sheet& sheet) {
  if (!sheet.things.empty()) {
    gl_.ReadBuffer(GL_COLOR_ATTACHMENT0);
    gl_.ReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, sheet.things.data());
  }
  if (sheet.ranges.empty()) return;
  gl_.ReadBuffer(GL_COLOR_ATTACHMENT1);
  gl_.ReadPixels(0, 0, width, height, GL_RED, GL_FLOAT, sheet.ranges.data());
}

}  // namespace ortung
