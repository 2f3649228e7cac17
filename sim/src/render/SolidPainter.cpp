#include "SolidPainter.hpp"

#include <cstddef>

namespace ortung {
namespace {

constexpr std::uint8_t kNetCovers = 80;  ///< opacity of a net, of 255

// Locations of the attributes, as in the shader.
enum : GLuint { kPlace, kNormal, kMatrix, kStands, kPaint, kBand };

const void* at(std::size_t offset) { return reinterpret_cast<const void*>(offset); }

void vertices(const GlFunctions& gl, std::span<const WallVertex> all) {
  GLuint buffer = 0;
  gl.GenBuffers(1, &buffer);
  gl.BindBuffer(GL_ARRAY_BUFFER, buffer);
  gl.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(all.size_bytes()), all.data(),
                GL_STATIC_DRAW);
  gl.VertexAttribPointer(kPlace, 3, GL_FLOAT, GL_FALSE, sizeof(WallVertex),
                         at(offsetof(WallVertex, place)));
  gl.VertexAttribPointer(kNormal, 3, GL_FLOAT, GL_FALSE, sizeof(WallVertex),
                         at(offsetof(WallVertex, normal)));
  gl.EnableVertexAttribArray(kPlace);
  gl.EnableVertexAttribArray(kNormal);
}

}  // namespace

SolidPainter::SolidPainter(const GlFunctions& gl, const StandingScene& scene)
    : gl_(gl), scene_(scene), mesh_(unitMesh()) {
  gl_.GenVertexArrays(1, &bodies_);
  gl_.BindVertexArray(bodies_);
  vertices(gl_, mesh_.vertices);
  GLuint corners = 0;
  gl_.GenBuffers(1, &corners);
  gl_.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, corners);
  gl_.BufferData(GL_ELEMENT_ARRAY_BUFFER,
                 static_cast<GLsizeiptr>(mesh_.corners.size() * sizeof mesh_.corners[0]),
                 mesh_.corners.data(), GL_STATIC_DRAW);
  gl_.GenBuffers(1, &stretchedBuffer_);
  for (const GLuint place : {kMatrix, kStands, kPaint, kBand}) {
    gl_.EnableVertexAttribArray(place);
    gl_.VertexAttribDivisor(place, 1);
  }
  gl_.GenVertexArrays(1, &walls_);
  gl_.BindVertexArray(walls_);
  vertices(gl_, scene_.walls);
}

SolidPainter::Stretched SolidPainter::stretched(const Instance& one,
                                                const std::array<double, 3>& camera) {
  Stretched to;
  for (std::size_t i = 0; i < 4; ++i) to.matrix[i] = static_cast<float>(one.matrix[i]);
  to.stands = {static_cast<float>(one.x - camera[0]), static_cast<float>(one.y - camera[1]),
               static_cast<float>(one.zLow - camera[2]), static_cast<float>(one.zHigh - camera[2])};
  to.colour = one.colour;
  if (one.isNet) to.colour[3] = kNetCovers;
  to.band = one.band;
  return to;
}

void SolidPainter::prepare(std::span<const FaceView> faces, const std::array<double, 3>& camera,
                           std::span<const Instance> moving) {
  seen_.clear();
  runs_.resize(faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    for (auto& group : groups_) group.clear();
    for (const std::span<const Instance> all : {std::span(scene_.instances), moving})
      for (const Instance& one : all)
        if (faces[f].sees(one.x - camera[0], one.y - camera[1],
                          0.5 * (one.zLow + one.zHigh) - camera[2], one.reach))
          groups_[static_cast<std::size_t>(one.shape) + (one.isNet ? kUnitShapes : 0)].push_back(
              &one);
    for (std::size_t g = 0; g < kGroups; ++g) {
      runs_[f][g] = {static_cast<std::uint32_t>(seen_.size()),
                     static_cast<std::uint32_t>(groups_[g].size())};
      for (const Instance* one : groups_[g]) seen_.push_back(stretched(*one, camera));
    }
  }
  gl_.BindBuffer(GL_ARRAY_BUFFER, stretchedBuffer_);
  gl_.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(seen_.size() * sizeof(Stretched)),
                 seen_.data(), GL_STREAM_DRAW);
}

void SolidPainter::attributes(std::size_t firstInstance) const {
  const std::size_t first = firstInstance * sizeof(Stretched);
  gl_.BindBuffer(GL_ARRAY_BUFFER, stretchedBuffer_);
  constexpr GLsizei kStride = sizeof(Stretched);
  gl_.VertexAttribPointer(kMatrix, 4, GL_FLOAT, GL_FALSE, kStride,
                          at(first + offsetof(Stretched, matrix)));
  gl_.VertexAttribPointer(kStands, 4, GL_FLOAT, GL_FALSE, kStride,
                          at(first + offsetof(Stretched, stands)));
  gl_.VertexAttribPointer(kPaint, 4, GL_UNSIGNED_BYTE, GL_TRUE, kStride,
                          at(first + offsetof(Stretched, colour)));
  gl_.VertexAttribPointer(kBand, 4, GL_UNSIGNED_BYTE, GL_TRUE, kStride,
                          at(first + offsetof(Stretched, band)));
}

void SolidPainter::paint(std::size_t face, std::size_t fromGroup, std::size_t toGroup) const {
  gl_.BindVertexArray(bodies_);
  for (std::size_t g = fromGroup; g < toGroup; ++g) {
    const Run& run = runs_[face][g];
    if (run.count == 0) continue;
    attributes(run.first);
    const std::size_t shape = g % kUnitShapes;
    gl_.DrawElementsInstanced(GL_TRIANGLES, static_cast<GLsizei>(mesh_.count[shape]),
                              GL_UNSIGNED_SHORT, at(mesh_.first[shape] * sizeof mesh_.corners[0]),
                              static_cast<GLsizei>(run.count));
  }
}

void SolidPainter::paintBodies(std::size_t face) const { paint(face, 0, kUnitShapes); }
void SolidPainter::paintNets(std::size_t face) const { paint(face, kUnitShapes, kGroups); }

void SolidPainter::paintWalls(const FaceView& face, const std::array<double, 3>& camera) {
  if (scene_.walls.empty()) return;
  const double x = scene_.middle.x - camera[0];
  const double y = scene_.middle.y - camera[1];
  firsts_.clear();
  counts_.clear();
  for (const Chunk& chunk : scene_.wallChunks) {
    if (!face.sees(chunk.x + x, chunk.y + y, chunk.z - camera[2], chunk.reach)) continue;
    firsts_.push_back(static_cast<GLint>(chunk.first));
    counts_.push_back(static_cast<GLsizei>(chunk.count));
  }
  if (firsts_.empty()) return;
  gl_.BindVertexArray(walls_);
  gl_.VertexAttrib4f(kMatrix, 1.0F, 0.0F, 0.0F, 1.0F);
  gl_.VertexAttrib4f(kStands, static_cast<float>(x), static_cast<float>(y),
                     static_cast<float>(-camera[2]), static_cast<float>(1.0 - camera[2]));
  gl_.VertexAttrib4f(kPaint, 0.78F, 0.78F, 0.76F, 1.0F);
  gl_.VertexAttrib4f(kBand, 0.0F, 0.0F, 0.0F, 0.0F);
  gl_.MultiDrawArrays(GL_TRIANGLES, firsts_.data(), counts_.data(),
                      static_cast<GLsizei>(firsts_.size()));
}

}  // namespace ortung
