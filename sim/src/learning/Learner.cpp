#include "ortung/sim/Learner.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "CheckedSensor.hpp"
#include "FloorParts.hpp"
#include "ortung/base/Angles.hpp"

namespace ortung {
namespace {

/// A device with its simulation half, which may be null.
struct Learning {
  const Device* device;
  std::unique_ptr<Sensor> sensor;
};

/// Features of one device at one place on the robot.
struct Group {
  const Learning* learning;
  std::vector<const Learning*> inputs;  ///< what else must generate data before: for made features
  Pose2 robotInSensor;                  ///< inverse of the mount
  std::vector<SensorData*> data;
};

/// Everything that is learned in the same headings.
struct Sweep {
  double spacing;  ///< between headings [rad]
  std::size_t headings;
  std::vector<Group> groups;
};

bool isSame(const Pose2& a, const Pose2& b) {
  return a.x == b.x && a.y == b.y && a.theta == b.theta;
}

/// The devices whose readings a feature is made of, directly or not; none for what a sensor
/// measures.
std::vector<const Learning*> inputsOf(const SensorData& made, std::span<const Learning> all) {
  std::vector<const Learning*> found;
  std::vector<const SensorData*> open = {&made};
  while (!open.empty()) {
    const SensorData* next = open.back();
    open.pop_back();
    for (const SensorData* input : all.front().device->container->inputsOf(*next)) {
      open.push_back(input);
      for (const Learning& one : all) {
        const auto& data = one.device->data;
        const bool has = std::find(data.begin(), data.end(), input) != data.end();
        const bool isNew = std::find(found.begin(), found.end(), &one) == found.end();
        if (has && isNew && one.sensor) found.push_back(&one);
      }
    }
  }
  return found;
}

void addTo(std::vector<Sweep>& sweeps, const Learning& learning, SensorData& data,
           std::span<const Learning> all) {
  const double spacing = std::clamp(data.headingSpacing(), 1e-4, kTurn);
  auto sweep = std::find_if(sweeps.begin(), sweeps.end(),
                            [&](const Sweep& s) { return s.spacing == spacing; });
  if (sweep == sweeps.end()) {
    // Headings that are no whole number a turn overlap at its end instead of leaving a gap.
    const auto headings = static_cast<std::size_t>(std::ceil(kTurn / spacing - 1e-6));
    sweep = sweeps.insert(sweeps.end(), {spacing, headings, {}});
  }
  const Pose2 robotInSensor = inverse(data.mount());
  auto group = std::find_if(sweep->groups.begin(), sweep->groups.end(), [&](const Group& g) {
    return g.learning == &learning && isSame(g.robotInSensor, robotInSensor);
  });
  if (group == sweep->groups.end())
    group = sweep->groups.insert(sweep->groups.end(), {&learning, {}, robotInSensor, {}});
  group->data.push_back(&data);
  const std::vector<const Learning*> inputs = inputsOf(data, all);
  if (inputs.empty() && !learning.sensor)
    throw std::invalid_argument(toText(data.id()) +
                                ": nothing in the simulator gives it, nor what it is made of, "
                                "so it can't be learned");
  for (const Learning* input : inputs)
    if (std::find(group->inputs.begin(), group->inputs.end(), input) == group->inputs.end())
      group->inputs.push_back(input);
}

/// Features that are made of others: those are generated first. What is not made at this pose is
/// not learned there.
void learnMade(const SimWorld& world, const RobotState& state, const Group& group, Timestamp now) {
  std::vector<std::uint64_t> before;
  for (const SensorData* data : group.data) before.push_back(data->sequence());
  for (const Learning* input : group.inputs)
    input->sensor->generateData(world, state, nullptr, now, input->device->data);
  group.learning->device->container->extract();
  for (std::size_t i = 0; i < group.data.size(); ++i)
    if (group.data[i]->sequence() != before[i]) group.data[i]->learnProbability(state.pose);
}

/// One step of the sweep: the sensors stand at @p sensorInField.
void learnAt(const SimWorld& world, const Pose2& sensorInField, const std::vector<Group>& groups,
             Timestamp now) {
  RobotState state;
  for (const Group& group : groups) {
    state.pose = sensorInField * group.robotInSensor;
    if (group.inputs.empty()) {
      group.learning->sensor->generateData(world, state, nullptr, now, group.data);
      for (SensorData* data : group.data) data->learnProbability(state.pose);
    } else {
      learnMade(world, state, group, now);
    }
  }
}

/// Counts what is done and asks now and then whether to go on.
class Progress {
 public:
  Progress(std::size_t total, const std::function<bool(double)>& report)
      : total_(total), report_(report) {}

  void done(std::size_t steps) {
    done_ += steps;
    if (done_ < next_) return;
    next_ = done_ + total_ / 200 + 1;
    if (report_ && !report_(static_cast<double>(done_) / static_cast<double>(total_)))
      throw LearnCancelled("learning was cancelled after " + std::to_string(100 * done_ / total_) +
                           " %");
  }

 private:
  std::size_t total_;
  const std::function<bool(double)>& report_;
  std::size_t done_ = 0;
  std::size_t next_ = 0;
};

void runSweep(const SimWorld& world, const FieldRegion& region, const Sweep& sweep, Timestamp& now,
              Progress& progress) {
  for (std::size_t cell = 0; cell < region.open.size(); ++cell) {
    if (region.open[cell] == 0) continue;
    ++now;  // a sensor may keep what it knows of one moment: turning on the spot takes no time
    for (std::size_t k = 0; k < sweep.headings; ++k) {
      const double heading = static_cast<double>(k) * sweep.spacing;
      learnAt(world, {region.grid.centreX(cell), region.grid.centreY(cell), wrapAngle(heading)},
              sweep.groups, now);
    }
    progress.done(sweep.headings * sweep.groups.size());
  }
}

/// The part of the field that a point lies in. @throws std::invalid_argument
std::size_t partAround(const std::array<double, 2>& point, const FieldParts& parts) {
  const auto found = parts.partAt(point[0], point[1]);
  if (!found || parts.parts()[*found].cells == 0)
    throw std::invalid_argument("there is no room for the robot around (" +
                                std::to_string(point[0]) + ", " + std::to_string(point[1]) + ") m");
  return *found;
}

}  // namespace

LearnCancelled::~LearnCancelled() = default;

LearnArea learnArea(const SimWorld& world, double cell, const RobotSize& robot,
                    const std::optional<std::array<double, 2>>& inside) {
  const FieldRegion whole = world.region(cell, robot);
  whole.check();
  const FieldParts parts = floorParts(world, whole, robot);
  const std::size_t part = inside ? partAround(*inside, parts) : mainPart(world, parts);
  LearnArea area{parts.only(part), 0.0};
  for (std::size_t i = 0; i < whole.standable.size(); ++i)
    area.leftOut += whole.standable[i] != area.region.standable[i] ? cell * cell : 0.0;
  return area;
}

void learn(const SimWorld& world, const FieldRegion& region, const std::vector<Device>& devices,
           PluginFactory& factory, const LearnOptions& options,
           const std::function<bool(double)>& progress) {
  region.check();
  const double turns = kTurn / options.headingStep;
  if (!(options.headingStep > 0.0 && options.headingStep <= kTurn + 1e-9) ||
      std::abs(turns - std::round(turns)) > 1e-4 * turns)
    throw std::invalid_argument("LearnOptions::headingStep is " +
                                std::to_string(options.headingStep * 360.0 / kTurn) +
                                " degrees, must divide 360 degrees");
  std::vector<Learning> all;
  for (const Device& device : devices) all.push_back({&device, makeSensor(device, factory)});
  if (!devices.empty())
    devices.front().container->setField(std::make_shared<FieldModel>(fieldModelOf(world)));
  std::vector<SensorData*> learning;
  std::vector<Sweep> sweeps;
  for (const Learning& one : all) {
    for (SensorData* data : one.device->data) {
      if (!data->localizes()) continue;
      data->beginLearning(region, options.headingStep);
      learning.push_back(data);
      if (data->headingSpacing() > 0.0) addTo(sweeps, one, *data, all);
    }
  }
  const auto open = static_cast<std::size_t>(std::count_if(
      region.open.begin(), region.open.end(), [](std::uint8_t isOpen) { return isOpen != 0; }));
  std::size_t total = 0;
  for (const Sweep& sweep : sweeps) total += open * sweep.headings * sweep.groups.size();
  Progress counter(std::max<std::size_t>(total, 1), progress);
  Timestamp now = 0;
  for (const Sweep& sweep : sweeps) runSweep(world, region, sweep, now, counter);
  for (SensorData* data : learning) data->endLearning();
  if (progress) progress(1.0);
}

}  // namespace ortung
