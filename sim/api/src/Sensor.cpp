#include "ortung/sim_api/Sensor.hpp"

#include <stdexcept>

namespace ortung {

World::~World() = default;

void World::draw(const Drawing&, const Sheet&) const {
  throw std::runtime_error("this world draws no pictures");
}
Sensor::~Sensor() = default;

}  // namespace ortung
