#include "Sweeps.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "CheckedSensor.hpp"
#include "ortung/base/Angles.hpp"

namespace ortung {
namespace {

bool isSame(const Pose2& a, const Pose2& b) {
  return a.x == b.x && a.y == b.y && a.theta == b.theta;
}

/// Returns the devices from whose readings a feature is derived, directly or not; none for a
/// feature that a sensor measures.
std::vector<std::size_t> inputsOf(const SensorData& made, const Rig& rig) {
  std::vector<std::size_t> found;
  std::vector<const SensorData*> open = {&made};
  while (!open.empty()) {
    const SensorData* next = open.back();
    open.pop_back();
    for (const SensorData* input : rig.devices->front().container->inputsOf(*next)) {
      open.push_back(input);
      for (std::size_t i = 0; i < rig.devices->size(); ++i) {
        const auto& data = (*rig.devices)[i].data;
        const bool has = std::find(data.begin(), data.end(), input) != data.end();
        const bool isNew = std::find(found.begin(), found.end(), i) == found.end();
        if (has && isNew && rig.sensors[i]) found.push_back(i);
      }
    }
  }
  return found;
}

}  // namespace

Rig::Rig(const std::vector<Device>& d, PluginFactory& factory) : devices(&d) {
  for (const Device& device : d) sensors.push_back(makeSensor(device, factory));
}

std::size_t addTo(std::vector<Sweep>& sweeps, const FieldRegion& region, const Rig& rig,
                  std::size_t device, std::size_t feature) {
  const SensorData& data = *(*rig.devices)[device].data[feature];
  const double spacing = std::clamp(data.headingSpacing(), 1e-4, kTurn);
  const double apart = data.positionSpacing();
  auto sweep = std::find_if(sweeps.begin(), sweeps.end(), [&](const Sweep& s) {
    return s.spacing == spacing && s.positionSpacing == apart;
  });
  if (sweep == sweeps.end()) {
    // If the spacing does not divide a turn, headings overlap at its end instead of leaving a gap.
    const auto headings = static_cast<std::size_t>(std::ceil(kTurn / spacing - 1e-6));
    sweep =
        sweeps.insert(sweeps.end(), {spacing, apart, headings, openCellsApart(region, apart), {}});
  }
  const Pose2 robotInSensor = inverse(data.mount());
  auto group = std::find_if(sweep->groups.begin(), sweep->groups.end(), [&](const SweepGroup& g) {
    return g.device == device && isSame(g.robotInSensor, robotInSensor);
  });
  if (group == sweep->groups.end())
    group = sweep->groups.insert(sweep->groups.end(), {device, {}, robotInSensor, {}});
  group->features.push_back(feature);
  const std::vector<std::size_t> inputs = inputsOf(data, rig);
  if (inputs.empty() && !rig.sensors[device])
    throw std::invalid_argument(
        toText(data.id()) +
        ": no sensor in the simulator provides it or its inputs, so it can't "
        "be learned");
  for (const std::size_t input : inputs)
    if (std::find(group->inputs.begin(), group->inputs.end(), input) == group->inputs.end())
      group->inputs.push_back(input);
  return sweep->headings;
}

void generate(const World& world, const RobotState& state, const SweepGroup& group, const Rig& rig,
              Timestamp now, std::vector<SensorData*>& features, std::vector<char>& isNew) {
  const Device& device = (*rig.devices)[group.device];
  features.clear();
  for (const std::size_t feature : group.features) features.push_back(device.data[feature]);
  isNew.assign(features.size(), 1);
  if (group.inputs.empty()) {
    rig.sensors[group.device]->generateData(world, state, nullptr, now, features);
    return;
  }
  std::vector<std::uint64_t> before;
  for (const SensorData* data : features) before.push_back(data->sequence());
  // A device that simulates its derived feature itself needs no inputs.
  if (const auto& own = rig.sensors[group.device]) {
    own->generateData(world, state, nullptr, now, features);
    bool isAll = true;
    for (std::size_t i = 0; i < features.size(); ++i)
      isAll = isAll && features[i]->sequence() != before[i];
    if (isAll) return;
  }
  for (const std::size_t input : group.inputs)
    rig.sensors[input]->generateData(world, state, nullptr, now, (*rig.devices)[input].data);
  device.container->extract();
  for (std::size_t i = 0; i < features.size(); ++i)
    isNew[i] = features[i]->sequence() != before[i] ? 1 : 0;
}

}  // namespace ortung
