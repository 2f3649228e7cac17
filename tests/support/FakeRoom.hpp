#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <vector>

#include "ortung/base/Random.hpp"
#include "ortung/core/SensorContainer.hpp"
#include "ortung/formats/LandmarksData.hpp"
#include "ortung/formats/ScanData.hpp"

/// A world of which everything is known in closed form: an empty rectangular room around the
/// origin, with points in it that can be told apart.
namespace ortung::test {

inline constexpr double kPi = std::numbers::pi;

struct Room {
  double width = 8.0;   ///< along x [m]
  double height = 5.0;  ///< along y [m]

  /// Distance from a point within to the wall along @p angle [m].
  double range(double x, double y, double angle) const {
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    const double alongX =
        c == 0.0 ? std::numeric_limits<double>::infinity() : (std::copysign(width / 2, c) - x) / c;
    const double alongY =
        s == 0.0 ? std::numeric_limits<double>::infinity() : (std::copysign(height / 2, s) - y) / s;
    return std::min(alongX, alongY);
  }
  bool contains(double x, double y, double margin = 0.0) const {
    return std::abs(x) < width / 2 - margin && std::abs(y) < height / 2 - margin;
  }
  FieldRegion region(double cell, double robotRadius) const {
    FieldRegion region;
    region.grid = {-width / 2, -height / 2, cell, static_cast<int>(std::lround(width / cell)),
                   static_cast<int>(std::lround(height / cell))};
    for (std::size_t i = 0; i < region.grid.size(); ++i) {
      region.open.push_back(contains(region.grid.centreX(i), region.grid.centreY(i)));
      region.standable.push_back(
          contains(region.grid.centreX(i), region.grid.centreY(i), robotRadius));
    }
    return region;
  }
};

struct Point {
  std::uint32_t identity;
  double x;
  double y;
};

/// What a scanner at @p sensor reads without noise.
inline std::vector<std::uint32_t> scanWords(const Room& room, const Pose2& sensor,
                                            const ScanData::Config& c) {
  std::vector<float> ranges;
  for (int i = 0; i < c.beams; ++i) {
    ranges.push_back(static_cast<float>(
        room.range(sensor.x, sensor.y, sensor.theta + c.firstAngle + i * c.angleStep)));
  }
  std::vector<std::uint32_t> words;
  ScanData::encode(ranges, c.maxRange, words);
  return words;
}

inline double bearingTo(const Pose2& sensor, double x, double y) {
  return wrapAngle(std::atan2(y - sensor.y, x - sensor.x) - sensor.theta);
}

/// What a camera at @p sensor that sees all around reads without noise, or with Gaussian noise.
inline std::vector<std::uint32_t> landmarkWords(const std::vector<Point>& points,
                                                const Pose2& sensor, double maxRange,
                                                Random* noise = nullptr, double sigmaRange = 0.0,
                                                double sigmaBearing = 0.0) {
  LandmarksData::Reading reading;
  for (const Point& p : points) {
    const double range = std::hypot(p.x - sensor.x, p.y - sensor.y);
    if (range > maxRange) continue;
    reading.push_back(
        {p.identity, range + (noise ? sigmaRange * noise->gaussian() : 0.0),
         bearingTo(sensor, p.x, p.y) + (noise ? sigmaBearing * noise->gaussian() : 0.0)});
  }
  return LandmarksData::encode(reading);
}

/// The learner's loop (paper, section 5.2): the sensor on the centre of every open cell, in as many
/// headings as it needs; @p words gives its noise-free reading there.
inline void learnEverywhere(SensorData& data, const FieldRegion& region, double headingStep,
                            const std::function<std::vector<std::uint32_t>(const Pose2&)>& words) {
  data.beginLearning(region, headingStep);
  const auto headings = static_cast<int>(std::ceil(2 * kPi / data.headingSpacing() - 1e-9));
  for (std::size_t cell = 0; cell < region.grid.size(); ++cell) {
    if (region.open[cell] == 0) continue;
    for (int h = 0; h < headings; ++h) {
      const Pose2 sensor{region.grid.centreX(cell), region.grid.centreY(cell),
                         wrapAngle(h * data.headingSpacing())};
      data.setData(0, words(sensor));
      data.learnProbability(sensor * inverse(data.mount()));
    }
  }
  data.endLearning();
}

/// ln p of one pose by the batch call of a feature or of a container.
template <class Weighing>
float batchOfOne(const Weighing& weighing, const Pose2& pose) {
  const auto x = static_cast<float>(pose.x);
  const auto y = static_cast<float>(pose.y);
  const auto theta = static_cast<float>(pose.theta);
  float logProbability = 0.0F;
  weighing.getProbability(SampleView{{&x, 1}, {&y, 1}, {&theta, 1}}, {&logProbability, 1});
  return logProbability;
}

/// p = (1 - o) exp(-r^2 / 2 sigma^2) + o, then ^exponent: the sensor model, written down again.
inline double modelled(double residual, double sigma, double outliers, double exponent = 1.0) {
  return std::pow(
      (1.0 - outliers) * std::exp(-residual * residual / (2 * sigma * sigma)) + outliers, exponent);
}

}  // namespace ortung::test
