#include "SimulatedBound.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>
#include <vector>

#include "ortung/base/Angles.hpp"
#include "ortung/formats/FeatureOf.hpp"
#include "ortung/formats/FormatNames.hpp"
#include "ortung/formats/OdometryData.hpp"
#include "ortung/run/Robot.hpp"
#include "ortung/sim/SimWorld.hpp"
#include "ortung/sim_api/Sensor.hpp"
#include "ortung/study/NoiseFit.hpp"

namespace ortung::app {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
// Steps of differences: words are of 1 mm and 0.01 degrees.
constexpr std::array<double, 3> kSteps = {0.02, 0.02, 0.5 * kDegree};
// Where a beam grazes a wall, the wall ends within a large step; small ones are for these alone,
// since words are coarse beside them.
constexpr std::array<double, 2> kScales = {1.0, 0.2};
// Where an expectation bends by more within a step there is an edge, of which no slope tells.
constexpr double kBendMetres = 0.01;
constexpr double kBendRadians = 0.01;

/// What was measured, in an order that is the same for each reading; NaN for nothing.
struct Values {
  std::vector<double> ranges;    ///< [m]
  std::vector<double> bearings;  ///< [rad]
};

double finiteOr(double value) { return std::isfinite(value) ? value : kNan; }

/// Of lists that name landmarks, which of these are seen differs from reading to reading: each has
/// its place in them.
void add(const SensorData& feature, const Pose2& truth, Values& out) {
  const std::vector<double> measured = feature.measured(truth);
  for (std::size_t i = 0; i < measured.size(); ++i)
    (feature.isAngle(i) ? out.bearings : out.ranges).push_back(finiteOr(measured[i]));
}

struct Slope {
  double value;
  double bend;  ///< by how much the differences to both sides are not each other's opposite
};

/// @param values at one step before the place, there, and at one step after it
/// @param isTurn the step is one of the heading
Slope slopeOf(const std::array<double, 3>& values, bool isAngle, bool isTurn, double step) {
  const auto [before, middle, after] = values;
  if (isTurn && !isAngle) {
    // Along a straight wall, however it slants, the inverse of the range is a sine of the heading:
    // its differences are those of sines, which no step makes wrong.
    const double square = middle * middle;
    return {-square * (1.0 / after - 1.0 / before) / (2.0 * std::sin(step)),
            square * std::abs(1.0 / after + 1.0 / before - 2.0 / middle * std::cos(step))};
  }
  const double up = isAngle ? wrapAngle(after - middle) : after - middle;
  const double down = isAngle ? wrapAngle(middle - before) : middle - before;
  return {(up + down) / (2.0 * step), std::abs(up - down)};
}

/// Readings without noise around a pose.
struct Sides {
  double scale = 1.0;  ///< of kSteps
  std::array<std::array<Values, 2>, 3> values;
};

/// One value of a reading at the true pose.
struct Seen {
  std::size_t step = 0;
  NoiseResidual residual;
  std::array<double, 3> slope{};  ///< by x, y, theta
};

}  // namespace

struct SimulatedBound::Parts {
  struct Mounted {
    Device device;
    std::unique_ptr<Sensor> sensor;
    std::map<std::string, std::uint64_t> sequences;
    std::vector<Seen> seen;
  };

  std::unique_ptr<Robot> robot;
  std::unique_ptr<SimWorld> world;
  std::vector<Mounted> sensors;
  std::vector<BoundStep> steps;

  Values at(Mounted& mounted, const Pose2& pose, Timestamp stamp,
            const std::vector<SensorData*>& wanted) const {
    RobotState state;
    state.pose = pose;
    mounted.sensor->generateData(*world, state, nullptr, stamp, mounted.device.data);
    Values values;
    for (const SensorData* feature : wanted) add(*feature, pose, values);
    return values;
  }

  /// Those of a device's features that have a new reading, and that reading.
  std::vector<SensorData*> news(Mounted& mounted, const SensorContainer& container,
                                const Pose2& truth, Values& read) const {
    std::vector<SensorData*> wanted;
    for (SensorData* ideal : mounted.device.data) {
      const SensorData* actual = container.findExactly(ideal->id());
      if (actual == nullptr || !actual->localizes() || actual->sequence() == 0) continue;
      std::uint64_t& sequence = mounted.sequences[toText(ideal->id())];
      if (sequence == actual->sequence()) continue;
      sequence = actual->sequence();
      add(*actual, truth, read);
      wanted.push_back(ideal);
    }
    return wanted;
  }

  bool look(Mounted& mounted, const SensorContainer& container, Timestamp stamp,
            const Pose2& truth) {
    Values read;
    const std::vector<SensorData*> wanted = news(mounted, container, truth, read);
    if (wanted.empty()) return false;
    const Values middle = at(mounted, truth, stamp, wanted);
    std::vector<Sides> sides;
    for (const double scale : kScales)
      sides.push_back(sidesOf(mounted, truth, stamp, wanted, scale));
    take(mounted, read, middle, sides, &Values::ranges, false, stamp);
    take(mounted, read, middle, sides, &Values::bearings, true, stamp);
    return true;
  }

  Sides sidesOf(Mounted& mounted, const Pose2& truth, Timestamp stamp,
                const std::vector<SensorData*>& wanted, double scale) const {
    Sides sides;
    sides.scale = scale;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (std::size_t side = 0; side < 2; ++side) {
        const double step = (side == 0 ? -scale : scale) * kSteps[axis];
        Pose2 pose = truth;
        (axis == 0 ? pose.x : axis == 1 ? pose.y : pose.theta) += step;
        pose.theta = wrapAngle(pose.theta);
        sides.values[axis][side] = at(mounted, pose, stamp, wanted);
      }
    }
    return sides;
  }

  void take(Mounted& mounted, const Values& read, const Values& middle,
            const std::vector<Sides>& sides, std::vector<double> Values::* kind, bool isAngle,
            Timestamp stamp) const {
    for (std::size_t i = 0; i < (read.*kind).size(); ++i) {
      Seen seen;
      seen.step = steps.size();
      const double expected = (middle.*kind)[i];
      const double off = (read.*kind)[i] - expected;
      seen.residual.stamp = stamp;
      seen.residual.isAngle = isAngle;
      seen.residual.residual = isAngle ? wrapAngle(off) : off;
      seen.residual.range = isAngle ? 0.0 : expected;
      if (!std::isfinite(off)) continue;
      const auto isFound = [&](const Sides& some) {
        bool isSmooth = true;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const auto& [before, after] = some.values[axis];
          const Slope slope = slopeOf({(before.*kind)[i], expected, (after.*kind)[i]}, isAngle,
                                      axis == 2, some.scale * kSteps[axis]);
          seen.slope[axis] = slope.value;
          isSmooth = isSmooth && slope.bend < (isAngle ? kBendRadians : kBendMetres);
        }
        return isSmooth;
      };
      if (std::any_of(sides.begin(), sides.end(), isFound)) mounted.seen.push_back(seen);
    }
  }

  /// Adds what a device's readings say, with the noise that they had.
  void inform(const Mounted& mounted, std::vector<BoundStep>& all) const {
    std::vector<NoiseResidual> residuals;
    for (const Seen& seen : mounted.seen) residuals.push_back(seen.residual);
    if (residuals.empty()) return;
    const NoiseFit fit = fitNoise(residuals, {});
    for (const Seen& seen : mounted.seen) {
      const NoiseShape& shape = seen.residual.isAngle ? fit.angles : fit.distances;
      const double sigma = shape.sigma.value + shape.sigmaPerMetre.value * seen.residual.range;
      const double weight = (1.0 - shape.outliers.value) / (sigma * sigma);
      for (std::size_t k = 0; k < 9; ++k)
        all[seen.step].information[k] += weight * seen.slope[k / 3] * seen.slope[k % 3];
    }
  }
};

SimulatedBound::SimulatedBound(const std::filesystem::path& world,
                               const std::filesystem::path& robot)
    : parts_(std::make_unique<Parts>()) {
  parts_->robot = openRobot(robot);
  parts_->world = readWorld(world);
  for (const Device& device : parts_->robot->devices) {
    const bool isUseful = std::any_of(device.data.begin(), device.data.end(),
                                      [](const SensorData* data) { return data->localizes(); });
    if (!isUseful || device.hasExtractor) continue;
    parts_->sensors.push_back(
        {device,
         parts_->robot->factory.make<Sensor>(device.config->plugin, device.config->parameters),
         {},
         {}});
  }
}

SimulatedBound::~SimulatedBound() = default;

void SimulatedBound::look(const SensorContainer& container, Timestamp stamp,
                          const std::optional<Pose2>& truth) {
  if (!truth) return;
  const SensorData* first = firstOf(container.all(), formats::kOdometry);
  const auto odometry = first == nullptr ? std::nullopt : readingAs<OdometryData>(*first);
  if (!odometry) return;
  bool any = false;
  for (Parts::Mounted& mounted : parts_->sensors)
    any = parts_->look(mounted, container, stamp, *truth) || any;
  if (any) parts_->steps.push_back({stamp, *truth, odometry->pose, {}});
}

std::vector<BoundStep> SimulatedBound::steps() const {
  std::vector<BoundStep> steps = parts_->steps;
  for (const Parts::Mounted& mounted : parts_->sensors) parts_->inform(mounted, steps);
  return steps;
}

}  // namespace ortung::app
