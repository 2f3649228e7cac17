#include "ortung/container/OdometryMotion.hpp"
#include "ortung/container/Plugin.hpp"

namespace ortung {
namespace {

/// [motion] of the robot file, without what says which plugin it is for.
OdometryNoise readNoise(const Parameters& motion) {
  motion.textOr("plugin", "");
  return OdometryNoise::read(motion);
}

/// A robot that drives where it faces moves by turn, way, turn.
class DifferentialMotion : public OdometryMotion {
 public:
  explicit DifferentialMotion(const Parameters& motion) : OdometryMotion(readNoise(motion)) {}
};

}  // namespace
}  // namespace ortung

ORTUNG_PLUGINS("differential_motion",
               ortung::provide<ortung::MotionModel, ortung::DifferentialMotion>("differential"));
