#include "ortung/core/Plugin.hpp"
#include "ortung/motion/OdometryMotion.hpp"

// The motion of robots whose file names none. A library of its own, since plugins are looked for by
// the names of their files first: else each such robot would open all plugins that there are.
ORTUNG_PLUGINS("odometry_motion",
               ortung::provide<ortung::MotionModel, ortung::OdometryMotion>("odometry"));
