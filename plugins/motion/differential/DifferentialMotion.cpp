#include "ortung/core/Plugin.hpp"
#include "ortung/motion/OdometryMotion.hpp"

// A robot that drives where it faces moves by turn, way, turn. "odometry" is the same for robots
// whose kind of drive nobody told.
ORTUNG_PLUGINS("differential_motion",
               ortung::provide<ortung::MotionModel, ortung::OdometryMotion>("differential"));
