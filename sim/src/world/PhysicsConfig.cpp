#include "ortung/sim/PhysicsConfig.hpp"

namespace ortung {

PhysicsConfig PhysicsConfig::read(const Parameters& physics) {
  PhysicsConfig c;
  c.cycle = physics.numberOr("cycle_ms", 1000.0 * c.cycle, {0.1, 1000.0}) / 1000.0;
  c.friction = physics.numberOr("friction", c.friction, {0.0, 10.0});
  c.restitution = physics.numberOr("restitution", c.restitution, {0.0, 1.0});
  c.floorFriction = physics.numberOr("floor_friction", c.floorFriction, {0.0, 10.0});
  c.rollingResistance = physics.numberOr("rolling_resistance", c.rollingResistance, {0.0, 1.0});
  physics.refuseUnread();
  return c;
}

}  // namespace ortung
