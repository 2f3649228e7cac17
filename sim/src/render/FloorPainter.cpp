#include "FloorPainter.hpp"

#include <cstddef>

namespace ortung {
namespace {

constexpr double kBeyond = 2500.0;  ///< how far the floor extends beyond the field [m]

const void* at(std::size_t offset) { return reinterpret_cast<const void*>(offset); }

GLuint arrayOf(const GlFunctions& gl, const void* data, std::size_t bytes) {
  GLuint array = 0;
  GLuint buffer = 0;
  gl.GenVertexArrays(1, &array);
  gl.BindVertexArray(array);
  gl.GenBuffers(1, &buffer);
  gl.BindBuffer(GL_ARRAY_BUFFER, buffer);
  gl.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(bytes), data, GL_STATIC_DRAW);
  return array;
}

/// Returns the triangles of the floor around the field without overlaps, and of the horizon around
/// that.
std::vector<std::array<float, 3>> floorOf(const Box2& field) {
  std::vector<std::array<float, 3>> vertices;
  using Corner = std::array<double, 3>;
  const auto quad = [&](const Corner& a, const Corner& b, const Corner& c, const Corner& d) {
    for (const Corner& corner : {a, b, c, a, c, d})
      vertices.push_back({static_cast<float>(corner[0]), static_cast<float>(corner[1]),
                          static_cast<float>(corner[2])});
  };
  const auto rectangle = [&](double x0, double x1, double y0, double y1) {
    quad({x0, y0, 0}, {x1, y0, 0}, {x1, y1, 0}, {x0, y1, 0});
  };
  const Box2& f = field;
  const Box2 all{f.xLow - kBeyond, f.xHigh + kBeyond, f.yLow - kBeyond, f.yHigh + kBeyond};
  rectangle(all.xLow, f.xLow, f.yLow, f.yHigh);
  rectangle(f.xHigh, all.xHigh, f.yLow, f.yHigh);
  rectangle(all.xLow, all.xHigh, all.yLow, f.yLow);
  rectangle(all.xLow, all.xHigh, f.yHigh, all.yHigh);
  const auto wall = [&](double x0, double y0, double x1, double y1) {
    quad({x0, y0, 0}, {x1, y1, 0}, {x1, y1, kBeyond}, {x0, y0, kBeyond});
  };
  wall(all.xLow, all.yLow, all.xHigh, all.yLow);
  wall(all.xHigh, all.yLow, all.xHigh, all.yHigh);
  wall(all.xHigh, all.yHigh, all.xLow, all.yHigh);
  wall(all.xLow, all.yHigh, all.xLow, all.yLow);
  quad({all.xLow, all.yLow, kBeyond}, {all.xHigh, all.yLow, kBeyond},
       {all.xHigh, all.yHigh, kBeyond}, {all.xLow, all.yHigh, kBeyond});
  return vertices;
}

constexpr GLsizei kQuad = 6;  ///< vertices of a rectangle

}  // namespace

FloorPainter::FloorPainter(const GlFunctions& gl, const StandingScene& scene)
    : gl_(gl), scene_(scene) {
  const auto floor = floorOf(scene.field);
  floor_ = arrayOf(gl_, floor.data(), floor.size() * sizeof floor[0]);
  gl_.VertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, at(0));
  gl_.EnableVertexAttribArray(0);
  constexpr GLsizei kStride = sizeof(LineVertex);
  lines_ = arrayOf(gl_, scene.lines.data(), scene.lines.size() * sizeof(LineVertex));
  gl_.VertexAttribPointer(0, 4, GL_FLOAT, GL_FALSE, kStride, at(offsetof(LineVertex, x)));
  gl_.VertexAttribPointer(1, 4, GL_FLOAT, GL_FALSE, kStride, at(offsetof(LineVertex, endX)));
  gl_.VertexAttribPointer(2, 2, GL_FLOAT, GL_FALSE, kStride, at(offsetof(LineVertex, along)));
  gl_.VertexAttribPointer(3, 4, GL_UNSIGNED_BYTE, GL_TRUE, kStride,
                          at(offsetof(LineVertex, colour)));
  for (const GLuint place : {0U, 1U, 2U, 3U}) gl_.EnableVertexAttribArray(place);
  gl_.GenBuffers(1, &indexBuffer_);
  gl_.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, indexBuffer_);
}

void FloorPainter::paint(GLint first, GLsizei count) const {
  gl_.BindVertexArray(floor_);
  gl_.DrawArrays(GL_TRIANGLES, first * kQuad, count * kQuad);
}

void FloorPainter::paintGround() const { paint(0, 4); }
void FloorPainter::paintHorizon() const { paint(4, 5); }

void FloorPainter::paintLines(const FaceView& face, const std::array<double, 3>& camera) {
  const double x = scene_.middle.x - camera[0];
  const double y = scene_.middle.y - camera[1];
  indices_.clear();
  for (const Chunk& piece : scene_.lineChunks)
    if (face.sees(piece.x + x, piece.y + y, -camera[2], piece.reach))
      for (const std::uint32_t corner : {0U, 1U, 2U, 0U, 2U, 3U})
        indices_.push_back(piece.first + corner);
  if (indices_.empty()) return;
  gl_.BindVertexArray(lines_);
  gl_.BufferData(GL_ELEMENT_ARRAY_BUFFER,
                 static_cast<GLsizeiptr>(indices_.size() * sizeof indices_[0]), indices_.data(),
                 GL_STREAM_DRAW);
  gl_.DrawElements(GL_TRIANGLES, static_cast<GLsizei>(indices_.size()), GL_UNSIGNED_INT, nullptr);
}

}  // namespace ortung
