#include "ortung/sim_api/Sensor.hpp"

namespace ortung {

World::~World() = default;
Sensor::~Sensor() = default;

}  // namespace ortung
