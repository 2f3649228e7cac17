#pragma once

#include <array>
#include <span>
#include <vector>

#include "FaceView.hpp"
#include "GlContext.hpp"
#include "StandingScene.hpp"

namespace ortung {

/// Draws bodies: for each face only those that may be visible, and all of one shape in one call.
/// @pre its context is current, whenever it is used
class SolidPainter {
 public:
  SolidPainter(const GlFunctions& gl, const StandingScene& scene);

  /// Selects and sorts the bodies that each face sees.
  void prepare(std::span<const FaceView> faces, const std::array<double, 3>& camera,
               std::span<const Instance> moving);
  /// @pre a program of solids is in use
  void paintBodies(std::size_t face) const;
  void paintNets(std::size_t face) const;
  void paintWalls(const FaceView& face, const std::array<double, 3>& camera);

 private:
  /// An instance as the shader reads it.
  struct Stretched {
    std::array<float, 4> matrix;
    std::array<float, 4> stands;
    Rgba colour;
    Rgba band;
  };
  struct Run {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
  };
  /// Number of groups: bodies by shape, then nets by shape.
  static constexpr std::size_t kGroups = 2 * kUnitShapes;
  static Stretched stretched(const Instance& instance, const std::array<double, 3>& camera);
  void attributes(std::size_t firstInstance) const;
  void paint(std::size_t face, std::size_t fromGroup, std::size_t toGroup) const;

  const GlFunctions& gl_;
  const StandingScene& scene_;
  UnitMesh mesh_;
  GLuint bodies_ = 0;  ///< vertex array of the bodies
  GLuint walls_ = 0;
  GLuint stretchedBuffer_ = 0;
  std::vector<Stretched> seen_;
  std::vector<std::array<Run, kGroups>> runs_;  ///< runs of instances in seen_, by face and group
  std::array<std::vector<const Instance*>, kGroups> groups_;
  std::vector<GLint> firsts_;
  std::vector<GLsizei> counts_;
};

}  // namespace ortung
