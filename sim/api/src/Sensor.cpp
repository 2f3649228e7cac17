#include "ortung/sim_api/Sensor.hpp"

#include <stdexcept>

namespace ortung {

World::~World() = default;

void World::draw(const Drawing&, const Sheet&) const {
  throw std::runtime_error("this world draws no pictures");
}
void World::trace(const Sight&, const Traced&) const {
  throw std::runtime_error("this world has nothing that a camera sees");
}
Sensor::~Sensor() = default;

}  // namespace ortung
