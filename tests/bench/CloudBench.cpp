/// Cost of making a planar scan of the cloud of a lidar: of 50 rings of 2,000 points each, beside a
/// loop that does the same as one writes it down.

#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "BenchField.hpp"
#include "CloudMaker.hpp"
#include "CloudShape.hpp"
#include "ortung/base/Angles.hpp"

namespace ortung::bench {
namespace {

using ros2::CloudBand;
using ros2::CloudLayout;
using ros2::CloudShape;
using ros2::PlanarVelocity;
using ros2::PointCloud;
using testing::CloudForm;
using testing::CloudPoint;

constexpr int kRings = 50, kColumns = 2000;
constexpr double kPoints = kRings * kColumns;
constexpr PlanarVelocity kMotion{1.0, 0.0, 0.5};

/// A lidar 0.7 m above the floor of a hall of 20 m x 12 m that is 3 m high, with noise of 2 cm.
/// @param isFlat whether all rings are in the band of heights, as the worst case; else a sixth is
PointCloud hall(const CloudForm& form, bool isFlat) {
  const double lowest = isFlat ? -2.0 : -25.0;
  const double highest = isFlat ? 4.0 : 15.0;
  std::vector<CloudPoint> points;
  for (int ring = 0; ring < kRings; ++ring) {
    const double rise = std::tan(radians(lowest + (highest - lowest) * ring / (kRings - 1)));
    for (int i = 0; i < kColumns; ++i) {
      const double bearing = kTurn * i / kColumns;
      const double c = std::cos(bearing);
      const double s = std::sin(bearing);
      double range = std::min(10.0 / std::abs(c), 6.0 / std::abs(s));
      range = rise < 0 ? std::min(range, -0.7 / rise) : std::min(range, 2.3 / rise);
      range += 0.02 * std::sin(12.9898 * i + 78.233 * ring);
      points.push_back({range * c, range * s, range * rise, 1e8 * i / kColumns});
    }
  }
  return testing::cloudOf(points, form);
}

CloudForm withTimes() {  // 48 bytes, as Ouster's
  CloudForm form;
  form.fields.push_back({"t", 20, CloudForm::Field::kWord, 1});
  form.pointStep = 48;
  form.rows = kRings;
  return form;
}
CloudForm ofDoubles() {
  CloudForm form;
  form.fields = {{"z", 1, CloudForm::Field::kDouble, 1},
                 {"y", 9, CloudForm::Field::kDouble, 1},
                 {"x", 17, CloudForm::Field::kDouble, 1}};
  form.pointStep = 25;
  form.isBigEndian = true;
  return form;
}

Eigen::Isometry3d mount() {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = Eigen::Vector3d(0.1, 0.0, 0.7);
  return pose;
}
Eigen::Matrix3d tilt() {
  return Eigen::AngleAxisd(0.03, Eigen::Vector3d::UnitY()).toRotationMatrix();
}

bool isFlat(const benchmark::State& state) { return state.range(0) == 1; }
const char* naiveName(const benchmark::State& state) { return isFlat(state) ? "flat" : "hall"; }

void measure(benchmark::State& state, const PointCloud& cloud, const PlanarVelocity& motion) {
  CloudShape shape(CloudBand(), mount());
  std::string why;
  const double seconds = fastest(state, [&] {
    const auto layout = CloudLayout::of(cloud, why);
    if (!layout || shape.fit(*layout, {tilt(), tilt(), motion}, why).empty())
      throw std::runtime_error(why);
  });
  state.counters["ms"] = seconds / 1e6;
  state.counters["points/s"] = kPoints / (seconds / 1e9);
  if (const auto naive = recall(naiveName(state))) state.counters["x_naive"] = *naive / seconds;
}

/// The same of floats without times, point by point in double precision.
std::vector<float> naive(const PointCloud& cloud, const CloudBand& band) {
  const Eigen::Isometry3d pose = tilt() * mount();
  std::vector<float> ranges(static_cast<std::size_t>(band.beams),
                            std::numeric_limits<float>::quiet_NaN());
  for (std::size_t i = 0; i < std::size_t{cloud.width} * cloud.height; ++i) {
    std::array<float, 3> place;  // its fields are the first ones
    std::memcpy(place.data(), cloud.data.data() + i * cloud.pointStep, sizeof place);
    const Eigen::Vector3d point = pose * Eigen::Vector3f(place.data()).cast<double>();
    if (!(point.z() >= band.minHeight && point.z() <= band.maxHeight)) continue;
    const double range = std::hypot(point.x() - 0.1, point.y());
    if (!(range >= band.minRange && range < band.maxRange)) continue;
    const double bearing = std::atan2(point.y(), point.x() - 0.1) + std::numbers::pi;
    const auto beam = static_cast<std::size_t>(bearing / kTurn * band.beams + 0.5) % ranges.size();
    if (!(ranges[beam] <= static_cast<float>(range))) ranges[beam] = static_cast<float>(range);
  }
  return ranges;
}

void naiveLoop(benchmark::State& state) {
  const PointCloud cloud = hall({}, isFlat(state));
  const double seconds =
      fastest(state, [&] { benchmark::DoNotOptimize(naive(cloud, CloudBand()).data()); });
  remember(naiveName(state), seconds);
  state.counters["ms"] = seconds / 1e6;
}
BENCHMARK(naiveLoop)->Unit(benchmark::kMillisecond)->Arg(0)->Arg(1);

void floats(benchmark::State& state) { measure(state, hall({}, isFlat(state)), {}); }
BENCHMARK(floats)->Unit(benchmark::kMillisecond)->Arg(0)->Arg(1);

void floatsWithMotion(benchmark::State& state) {
  measure(state, hall(withTimes(), isFlat(state)), kMotion);
}
BENCHMARK(floatsWithMotion)->Unit(benchmark::kMillisecond)->Arg(0)->Arg(1);

void bigEndianDoubles(benchmark::State& state) {
  measure(state, hall(ofDoubles(), isFlat(state)), {});
}
BENCHMARK(bigEndianDoubles)->Unit(benchmark::kMillisecond)->Arg(0)->Arg(1);

/// With reading the message of 4.8 MB.
void messageWithMotion(benchmark::State& state) {
  const std::string bytes = ros2::toCdr(hall(withTimes(), isFlat(state)));
  CloudShape shape(CloudBand(), mount());
  PointCloud cloud;
  std::string why;
  const double seconds = fastest(state, [&] {
    if (!ros2::fromCdr(bytes, cloud, why)) throw std::runtime_error(why);
    const auto layout = CloudLayout::of(cloud, why);
    if (!layout || shape.fit(*layout, {tilt(), tilt(), kMotion}, why).empty())
      throw std::runtime_error(why);
  });
  state.counters["ms"] = seconds / 1e6;
}
BENCHMARK(messageWithMotion)->Unit(benchmark::kMillisecond)->Arg(0)->Arg(1);

}  // namespace
}  // namespace ortung::bench

BENCHMARK_MAIN();
