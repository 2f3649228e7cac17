#include "ScanForecast.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "ortung/base/Angles.hpp"

namespace ortung {
namespace {

constexpr double kLeastSine =
    0.25;  // least sine of a beam's angle to its wall; flatter angles count as this one
constexpr double kSureReach =
    0.9;  // share of the greatest range within which an echo must come back

/// The wall of a beam: its range and the sine of the beam's angle to it.
struct Forecast {
  float range = std::numeric_limits<float>::infinity();
  float sine = 1.0F;
  bool isFromBehind = false;
};

/// Adds a wall to the beams that point at it.
void addWall(const MeasuredWall& wall, const Pose2& sensor, const MeasuredScan& scan,
             std::vector<Forecast>& forecasts) {
  const double x0 = wall.x0 - sensor.x;
  const double y0 = wall.y0 - sensor.y;
  const double off = wall.sine * x0 - wall.cosine * y0;  // positive on the visible side
  if (std::abs(off) > scan.maxRange + 1.0) return;       // no beam ends there
  const double a0 = std::atan2(y0, x0);
  const double span = wrapAngle(std::atan2(wall.y1 - sensor.y, wall.x1 - sensor.x) - a0);
  const double from = std::min(0.0, span) + a0 - sensor.theta - scan.firstAngle;
  const auto n = static_cast<double>(forecasts.size());
  double first = from - kTurn * std::floor(from / kTurn);  // in [0, 2 pi)
  for (first -= kTurn; first < n * scan.angleStep; first += kTurn) {
    const double low = std::max(std::ceil(first / scan.angleStep), 0.0);
    const double high = std::min(std::floor((first + std::abs(span)) / scan.angleStep), n - 1.0);
    for (double i = low; i <= high; i += 1.0) {
      const double angle = sensor.theta + scan.firstAngle + i * scan.angleStep;
      const double sine = wall.sine * std::cos(angle) - wall.cosine * std::sin(angle);
      const double range = off / sine;
      Forecast& forecast = forecasts[static_cast<std::size_t>(i)];
      if (!(range >= 0.0) || range >= static_cast<double>(forecast.range)) continue;
      forecast = {static_cast<float>(range), static_cast<float>(std::abs(sine)), off < 0.0};
    }
  }
}

}  // namespace

Agreement agreementOf(const MeasuredScan& scan, std::span<const MeasuredWall> walls,
                      const Pose2& sensor, double tolerance) {
  std::vector<Forecast> forecasts(scan.ranges.size());
  for (const MeasuredWall& wall : walls) addWall(wall, sensor, scan, forecasts);
  Agreement agreement;
  for (std::size_t i = 0; i < forecasts.size(); ++i) {
    if (std::isnan(scan.ranges[i])) continue;
    const auto range = static_cast<double>(scan.ranges[i]);
    const auto wall = static_cast<double>(forecasts[i].range);
    const bool isInReach = wall < kSureReach * scan.maxRange;
    agreement.expected += isInReach ? 1 : 0;
    const double reach = tolerance / std::max(static_cast<double>(forecasts[i].sine), kLeastSine);
    const bool hides = std::isinf(wall) || range < wall - reach;
    agreement.seen += std::isfinite(range) && !(hides && scan.isOfSmallBody[i] != 0) ? 1 : 0;
    if (std::isinf(wall)) continue;
    if (std::abs(range - wall) <= reach && !forecasts[i].isFromBehind)
      ++agreement.agreeing;
    else if (isInReach && range > wall + reach)
      ++agreement.through;
  }
  return agreement;
}

}  // namespace ortung
