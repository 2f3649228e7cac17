#include <stdexcept>

#include "Painters.hpp"
#include "ortung/sim/OpenGl.hpp"

// In place of Painters.cpp where OpenGL's headers are missing.
namespace ortung {

struct Painters::Painter {};

Painters::Painters() = default;
Painters::~Painters() = default;

void Painters::draw(const WorldModel&, std::span<const WorldObject>, std::size_t, const Drawing&,
                    const Sheet&) {
  openGlRenderer();
}

std::string openGlRenderer() {
  throw std::runtime_error(
      "this program was built without OpenGL (libosmesa6-dev, libegl-dev), so cameras take no "
      "pictures");
}

}  // namespace ortung
