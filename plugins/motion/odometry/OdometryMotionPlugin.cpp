#include "ortung/core/Plugin.hpp"
#include "ortung/motion/OdometryMotion.hpp"

// The motion model of robots whose file names none. It is a library of its own, since plugins are
// first searched by the names of their files: otherwise each such robot would open all plugins.
ORTUNG_PLUGINS("odometry_motion",
               ortung::provide<ortung::MotionModel, ortung::OdometryMotion>("odometry"));
