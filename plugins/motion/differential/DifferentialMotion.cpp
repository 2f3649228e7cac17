#include "ortung/core/Plugin.hpp"
#include "ortung/motion/OdometryMotion.hpp"

// A robot that drives where it faces moves by turn, straight motion, turn. The plugin "odometry" is
// the same for robots whose kind of drive is not known.
ORTUNG_PLUGINS("differential_motion",
               ortung::provide<ortung::MotionModel, ortung::OdometryMotion>("differential"));
