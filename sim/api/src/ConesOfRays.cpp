#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "ortung/sim_api/World.hpp"

namespace ortung {
namespace {

/// Greatest angle between rays of a slice [rad].
constexpr double kWidest = 2.0 * std::numbers::pi / 180.0;
constexpr double kFewest = 5.0;  ///< least number of rays between axis and edge

/// Elevations of the slices as shares of the angle to the cone's edge. At 0.6 of it the cone is 0.8
/// times as wide as at its axis, at 0.28 it is 0.96 times and at 0.96 it is 0.28 times as wide.
constexpr std::array<double, 7> kSlices = {0.0, -0.28, 0.28, -0.6, 0.6, -0.96, 0.96};

}  // namespace

void World::castCones(const ConeFan& fan, RobotNumber ignore, std::span<float> ranges) const {
  std::fill(ranges.begin(), ranges.end(), static_cast<float>(fan.maxRange));
  if (ranges.empty() || !(fan.halfAngle > 0.0 && fan.halfAngle < 1.5)) return;
  // Neighbouring cones share their rays.
  const double least = std::max(std::ceil(fan.halfAngle / kWidest), kFewest);
  const bool shares = ranges.size() > 1 && fan.angleStep > 0.0;
  const double raysACone =
      shares ? std::max(1.0, std::ceil(fan.angleStep * least / fan.halfAngle - 1e-9)) : 1.0;
  const double step = shares ? fan.angleStep / raysACone : fan.halfAngle / least;
  std::vector<float> rays;
  for (const double share : kSlices) {
    const double width = std::sqrt(1.0 - share * share) * fan.halfAngle;
    const auto toEachSide = static_cast<std::size_t>(std::floor(width / step + 1e-9));
    const auto between = static_cast<std::size_t>(raysACone);
    rays.resize((ranges.size() - 1) * between + 2 * toEachSide + 1);
    castFan({.x = fan.x,
             .y = fan.y,
             .z = fan.z,
             .firstAngle = fan.firstAngle - static_cast<double>(toEachSide) * step,
             .angleStep = step,
             .elevation = share * fan.halfAngle,
             .maxRange = fan.maxRange},
            ignore, rays);
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      const auto first = rays.begin() + static_cast<std::ptrdiff_t>(i * between);
      const auto last = first + static_cast<std::ptrdiff_t>(2 * toEachSide + 1);
      ranges[i] = std::min(ranges[i], *std::min_element(first, last));
    }
  }
}

}  // namespace ortung
