#include "CellLookup.hpp"

#include "ortung/base/FastMath.hpp"
#include "ortung/base/Widest.hpp"

namespace ortung {
namespace {

struct SensorPlaces {
  ORTUNG_INLINE static void run(SensorPoses robots, float mx, float my, float turn, std::size_t n,
                                float* x, float* y, float* theta) {
    for (std::size_t i = 0; i < n; ++i) {
      const SinCos heading = sinCos(robots.theta[i]);
      x[i] = robots.x[i] + heading.cos * mx - heading.sin * my;
      y[i] = robots.y[i] + heading.sin * mx + heading.cos * my;
      theta[i] = robots.theta[i] + turn;
    }
  }
};

}  // namespace

void placeSensors(const SensorPoses& robots, const Pose2& mount, std::size_t n, float* x, float* y,
                  float* theta) {
  runWidest<SensorPlaces>(robots, static_cast<float>(mount.x), static_cast<float>(mount.y),
                          static_cast<float>(mount.theta), n, x, y, theta);
}

}  // namespace ortung
