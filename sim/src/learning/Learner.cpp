#include "ortung/sim/Learner.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <utility>

#include "Sweeps.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/base/Workers.hpp"

namespace ortung {
namespace {

constexpr std::size_t kCellsAPiece = 8;  ///< number of cells in a thread's piece of work
constexpr std::size_t kPieces = 8;       ///< number of pieces in a step

void checkStep(double headingStep) {
  const double turns = kTurn / headingStep;
  if (!(headingStep > 0.0 && headingStep <= kTurn + 1e-9) ||
      std::abs(turns - std::round(turns)) > 1e-4 * turns)
    throw std::invalid_argument("LearnOptions::headingStep is " +
                                std::to_string(headingStep * 360.0 / kTurn) +
                                " degrees, must divide 360 degrees");
}

/// A cell at which a sweep learns, and its simulated time.
struct Stop {
  const Sweep* sweep;
  std::size_t cell;
  /// Time [us]; it is the same for all headings, so a sensor may cache what it sees at a place.
  Timestamp now;
};

/// The readings of some stops, as consecutive words.
struct Readings {
  /// Marks a missing reading, in place of its number of words.
  static constexpr std::uint32_t kNone = 0xffffffff;
  std::vector<Stop> stops;
  std::vector<std::uint32_t> words;
};

}  // namespace

struct Learner::Parts {
  const World& world;
  FieldRegion region;
  Rig own;
  std::vector<Rig> helpers;
  std::vector<Rig*> idle;  ///< helpers that are not in use
  std::mutex mutex;        ///< guards idle and failure
  std::exception_ptr failure;
  std::vector<SensorData*> learning;
  std::vector<Sweep> sweeps;
  std::vector<Need> needs;
  Workers workers;
  std::size_t total = 0;  ///< number of readings to learn: headings times groups over all cells
  std::size_t done = 0;
  std::size_t sweep = 0;  ///< index of the next stop's sweep
  std::size_t cell = 0;
  Timestamp now = 0;
  Pose2 pose;
  /// Readings that the helpers have generated and that are not yet learned.
  std::vector<Readings> made;
  bool isOver = false;

  Parts(const World& w, const FieldRegion& r, const std::vector<Device>& devices,
        std::span<const std::vector<Device>> more, PluginFactory& factory)
      : world(w),
        region(r),
        own(devices, factory),
        workers(static_cast<unsigned>(std::max<std::size_t>(more.size(), 1))) {
    for (const auto& one : more) helpers.emplace_back(one, factory);
    for (Rig& one : helpers) idle.push_back(&one);
  }

  void begin(const LearnOptions& options);
  std::vector<Stop> nextStops(std::size_t most);
  template <class Use>
  void standAt(const Stop& stop, const Use& use);
  void learnAt(const Stop& stop);
  void generateAll(Readings& readings);
  void learnFrom(const Readings& readings);
  void stepWithHelpers();
  void finish();
};

void Learner::Parts::begin(const LearnOptions& options) {
  region.check();
  checkStep(options.headingStep);
  const auto field = std::make_shared<FieldModel>(fieldModelOf(world));
  for (const Device& device : *own.devices) device.container->setField(field);
  for (const Rig& rig : helpers)
    for (const Device& device : *rig.devices) device.container->setField(field);
  for (std::size_t i = 0; i < own.devices->size(); ++i) {
    const Device& device = (*own.devices)[i];
    for (std::size_t k = 0; k < device.data.size(); ++k) {
      SensorData& data = *device.data[k];
      if (!data.localizes()) continue;
      data.beginLearning(region, options.headingStep);
      learning.push_back(&data);
      needs.push_back(
          {data.id(), data.headingSpacing() > 0.0 ? addTo(sweeps, region, own, i, k) : 0});
    }
  }
  for (const Sweep& one : sweeps) total += one.cells.size() * one.headings * one.groups.size();
}

std::vector<Stop> Learner::Parts::nextStops(std::size_t most) {
  std::vector<Stop> stops;
  for (; sweep < sweeps.size(); ++sweep, cell = 0)
    for (; cell < sweeps[sweep].cells.size(); ++cell) {
      if (stops.size() == most) return stops;
      stops.push_back({&sweeps[sweep], sweeps[sweep].cells[cell], ++now});
    }
  return stops;
}

/// Calls use(state, group) for all headings and groups.
template <class Use>
void Learner::Parts::standAt(const Stop& stop, const Use& use) {
  RobotState state;
  for (std::size_t k = 0; k < stop.sweep->headings; ++k) {
    const double heading = static_cast<double>(k) * stop.sweep->spacing;
    const Pose2 sensor{region.grid.centreX(stop.cell), region.grid.centreY(stop.cell),
                       wrapAngle(heading)};
    for (const SweepGroup& group : stop.sweep->groups) {
      state.pose = sensor * group.robotInSensor;
      use(state, group);
    }
  }
}

/// Generates and learns with the robot's own features.
void Learner::Parts::learnAt(const Stop& stop) {
  std::vector<SensorData*> features;
  std::vector<char> isNew;
  standAt(stop, [&](const RobotState& state, const SweepGroup& group) {
    generate(world, state, group, own, stop.now, features, isNew);
    for (std::size_t i = 0; i < features.size(); ++i)
      if (isNew[i] != 0) features[i]->learnProbability(state.pose);
  });
}

/// Generates readings with an idle helper; there is one for each thread.
void Learner::Parts::generateAll(Readings& readings) {
  Rig* rig = nullptr;
  {
    const std::lock_guard lock(mutex);
    rig = std::exchange(idle.back(), nullptr);
    idle.pop_back();
  }
  try {
    std::vector<SensorData*> features;
    std::vector<char> isNew;
    for (const Stop& stop : readings.stops) {
      if (&stop == readings.stops.data() + 1)
        readings.words.reserve(readings.words.size() * (readings.stops.size() + 1));
      standAt(stop, [&](const RobotState& state, const SweepGroup& group) {
        generate(world, state, group, *rig, stop.now, features, isNew);
        for (std::size_t i = 0; i < features.size(); ++i) {
          const std::span<const std::uint32_t> words = features[i]->getData();
          readings.words.push_back(isNew[i] != 0 ? static_cast<std::uint32_t>(words.size())
                                                 : Readings::kNone);
          if (isNew[i] != 0)
            readings.words.insert(readings.words.end(), words.begin(), words.end());
        }
      });
    }
  } catch (...) {
    const std::lock_guard lock(mutex);
    failure = std::current_exception();
  }
  const std::lock_guard lock(mutex);
  idle.push_back(rig);
}

/// Learns the readings of helpers in the order in which a single thread would generate them.
void Learner::Parts::learnFrom(const Readings& readings) {
  std::span<const std::uint32_t> rest = readings.words;
  for (const Stop& stop : readings.stops)
    standAt(stop, [&](const RobotState& state, const SweepGroup& group) {
      for (const std::size_t feature : group.features) {
        const std::uint32_t count = rest.front();
        rest = rest.subspan(1);
        if (count == Readings::kNone) continue;
        SensorData& data = *(*own.devices)[group.device].data[feature];
        data.setData(stop.now, rest.first(count));
        data.learnProbability(state.pose);
        rest = rest.subspan(count);
      }
    });
}

/// Learns the last step's readings while the next ones are generated.
void Learner::Parts::stepWithHelpers() {
  std::vector<Readings> next;
  for (std::size_t i = 0; i < kPieces * helpers.size(); ++i) {
    Readings readings{nextStops(kCellsAPiece), {}};
    if (readings.stops.empty()) break;
    next.push_back(std::move(readings));
  }
  workers.run(1 + next.size(), [&](std::size_t i) {
    if (i > 0) return generateAll(next[i - 1]);
    try {
      for (const Readings& readings : made) learnFrom(readings);
    } catch (...) {
      const std::lock_guard lock(mutex);
      failure = std::current_exception();
    }
  });
  if (failure) std::rethrow_exception(failure);
  made = std::move(next);
  if (made.empty()) finish();
}

void Learner::Parts::finish() {
  for (SensorData* data : learning) data->endLearning();
  isOver = true;
}

Learner::Learner(const World& world, const FieldRegion& region, const std::vector<Device>& devices,
                 std::span<const std::vector<Device>> helpers, PluginFactory& factory,
                 const LearnOptions& options)
    : parts_(std::make_unique<Parts>(world, region, devices, helpers, factory)) {
  parts_->begin(options);
}

Learner::~Learner() = default;

bool Learner::step() {
  Parts& parts = *parts_;
  if (parts.isOver) return false;
  std::vector<Stop> stops;
  if (parts.helpers.empty()) {
    stops = parts.nextStops(kCellsAPiece * kPieces);
    for (const Stop& stop : stops) parts.learnAt(stop);
    if (stops.empty()) parts.finish();
  } else {
    for (const Readings& readings : parts.made)
      stops.insert(stops.end(), readings.stops.begin(), readings.stops.end());
    parts.stepWithHelpers();
  }
  for (const Stop& stop : stops) parts.done += stop.sweep->headings * stop.sweep->groups.size();
  if (!stops.empty())
    parts.pose = {parts.region.grid.centreX(stops.back().cell),
                  parts.region.grid.centreY(stops.back().cell), 0.0};
  return !parts.isOver;
}

double Learner::share() const {
  if (parts_->isOver) return 1.0;
  return static_cast<double>(parts_->done) /
         static_cast<double>(std::max<std::size_t>(parts_->total, 1));
}

const Pose2& Learner::pose() const { return parts_->pose; }
const std::vector<Learner::Need>& Learner::needs() const { return parts_->needs; }

void learn(const World& world, const FieldRegion& region, const std::vector<Device>& devices,
           PluginFactory& factory, const LearnOptions& options) {
  Learner learner(world, region, devices, {}, factory, options);
  while (learner.step()) {
  }
}

}  // namespace ortung
