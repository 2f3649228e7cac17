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

/// The readings of some stops, as consecutive words: each reading's number of words, and they.
struct Batch {
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
  std::size_t total = 0;  ///< number of readings to make: headings times groups over all cells
  std::size_t done = 0;
  std::size_t left = 0;   ///< number of stops that are left
  std::size_t sweep = 0;  ///< index of the next stop's sweep
  std::size_t cell = 0;
  Timestamp now = 0;
  Pose2 pose;
  /// Readings that the helpers have generated and that are not yet learned.
  std::vector<Batch> made;
  Learner::Readings passOn;  ///< gets the readings, which are not learned then; may be empty
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
  std::size_t stopsOf(std::size_t readings) const;
  void skip(std::size_t stops);
  std::vector<Stop> nextStops(std::size_t most);
  template <class Use>
  void standAt(const Stop& stop, const Use& use);
  void learnAt(const Stop& stop);
  void generateAll(Batch& batch, const Rig& rig);
  void generateWithHelper(Batch& batch);
  std::span<const std::uint32_t> learnAt(const Stop& stop, std::span<const std::uint32_t> words);
  void use(const Batch& batch);
  std::vector<Stop> stepAlone();
  std::vector<Stop> stepWithHelpers();
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
  for (const Sweep& one : sweeps) {
    total += one.cells.size() * one.readingsACell();
    left += one.cells.size();
  }
}

/// Returns the number of the first stops that have at least so many readings.
std::size_t Learner::Parts::stopsOf(std::size_t readings) const {
  std::size_t stops = 0;
  for (const Sweep& one : sweeps) {
    const std::size_t each = one.readingsACell();
    const std::size_t needed = (readings + each - 1) / each;
    stops += std::min(needed, one.cells.size());
    if (needed <= one.cells.size()) break;
    readings -= each * one.cells.size();
  }
  return stops;
}

void Learner::Parts::skip(std::size_t stops) {
  now += static_cast<Timestamp>(stops);
  left -= stops;
  for (; stops > 0; ++sweep, cell = 0) {
    cell = std::min(stops, sweeps[sweep].cells.size());
    stops -= cell;
    if (cell < sweeps[sweep].cells.size()) break;
  }
}

std::vector<Stop> Learner::Parts::nextStops(std::size_t most) {
  std::vector<Stop> stops;
  for (; sweep < sweeps.size(); ++sweep, cell = 0)
    for (; cell < sweeps[sweep].cells.size(); ++cell) {
      if (stops.size() == most || left == 0) return stops;
      stops.push_back({&sweeps[sweep], sweeps[sweep].cells[cell], ++now});
      --left;
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

void Learner::Parts::generateAll(Batch& batch, const Rig& rig) {
  std::vector<SensorData*> features;
  std::vector<char> isNew;
  for (const Stop& stop : batch.stops) {
    if (&stop == batch.stops.data() + 1)
      batch.words.reserve(batch.words.size() * (batch.stops.size() + 1));
    standAt(stop, [&](const RobotState& state, const SweepGroup& group) {
      generate(world, state, group, rig, stop.now, features, isNew);
      for (std::size_t i = 0; i < features.size(); ++i) {
        const std::span<const std::uint32_t> words = features[i]->getData();
        batch.words.push_back(isNew[i] != 0 ? static_cast<std::uint32_t>(words.size())
                                            : Batch::kNone);
        if (isNew[i] != 0) batch.words.insert(batch.words.end(), words.begin(), words.end());
      }
    });
  }
}

/// Generates readings with an idle helper; there is one for each thread.
void Learner::Parts::generateWithHelper(Batch& batch) {
  Rig* rig = nullptr;
  {
    const std::lock_guard lock(mutex);
    rig = std::exchange(idle.back(), nullptr);
    idle.pop_back();
  }
  try {
    generateAll(batch, *rig);
  } catch (...) {
    const std::lock_guard lock(mutex);
    failure = std::current_exception();
  }
  const std::lock_guard lock(mutex);
  idle.push_back(rig);
}

/// Learns a stop's readings, which another rig has made. @returns the words behind them
/// @throws std::invalid_argument for words that are not such readings
std::span<const std::uint32_t> Learner::Parts::learnAt(const Stop& stop,
                                                       std::span<const std::uint32_t> words) {
  standAt(stop, [&](const RobotState& state, const SweepGroup& group) {
    for (const std::size_t feature : group.features) {
      if (words.empty()) throw std::invalid_argument("the readings end within a stop");
      const std::uint32_t count = words.front();
      words = words.subspan(1);
      if (count == Batch::kNone) continue;
      if (count > words.size()) throw std::invalid_argument("the readings end within a reading");
      SensorData& data = *(*own.devices)[group.device].data[feature];
      data.setData(stop.now, words.first(count));
      data.learnProbability(state.pose);
      words = words.subspan(count);
    }
  });
  return words;
}

/// Learns readings in the order in which a single thread would generate them, or gives them away.
void Learner::Parts::use(const Batch& batch) {
  if (passOn) return passOn(batch.words);
  std::span<const std::uint32_t> rest = batch.words;
  for (const Stop& stop : batch.stops) rest = learnAt(stop, rest);
}

/// @returns the stops that it learned or passed on
std::vector<Stop> Learner::Parts::stepAlone() {
  Batch batch{nextStops(kCellsAPiece * kPieces), {}};
  if (batch.stops.empty()) {
    finish();
  } else if (passOn) {
    generateAll(batch, own);
    passOn(batch.words);
  } else {
    for (const Stop& stop : batch.stops) learnAt(stop);
  }
  return batch.stops;
}

/// Uses the last step's readings while the next ones are generated. @returns the stops whose
/// readings it used
std::vector<Stop> Learner::Parts::stepWithHelpers() {
  std::vector<Batch> next;
  for (std::size_t i = 0; i < kPieces * helpers.size(); ++i) {
    Batch batch{nextStops(kCellsAPiece), {}};
    if (batch.stops.empty()) break;
    next.push_back(std::move(batch));
  }
  workers.run(1 + next.size(), [&](std::size_t i) {
    if (i > 0) return generateWithHelper(next[i - 1]);
    try {
      for (const Batch& batch : made) use(batch);
    } catch (...) {
      const std::lock_guard lock(mutex);
      failure = std::current_exception();
    }
  });
  if (failure) std::rethrow_exception(failure);
  std::vector<Stop> stops;
  for (const Batch& batch : made) stops.insert(stops.end(), batch.stops.begin(), batch.stops.end());
  made = std::move(next);
  if (made.empty()) finish();
  return stops;
}

void Learner::Parts::finish() {
  if (!passOn)
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

void Learner::passOn(std::uint64_t shard, std::uint64_t shards, Readings take) {
  Parts& parts = *parts_;
  if (shard < 1 || shard > shards)
    throw std::invalid_argument("shard " + std::to_string(shard) + " of " + std::to_string(shards) +
                                " does not exist");
  // How many readings the first n shards have, without an overflow.
  const auto readings = [&](std::uint64_t n) {
    return parts.total / shards * n + parts.total % shards * n / shards;
  };
  const std::size_t first = parts.stopsOf(readings(shard - 1));
  const std::size_t last = parts.stopsOf(readings(shard));
  parts.skip(first);
  parts.left = last - first;
  parts.total = readings(shard) - readings(shard - 1);
  parts.passOn = std::move(take);
}

void Learner::learnFrom(std::span<const std::uint32_t> readings) {
  while (!readings.empty()) {
    const std::vector<Stop> stops = parts_->nextStops(1);
    if (stops.empty()) throw std::invalid_argument("there are more readings than poses");
    readings = parts_->learnAt(stops.front(), readings);
    parts_->done += stops.front().sweep->readingsACell();
  }
}

void Learner::endLearning() {
  if (!parts_->nextStops(1).empty())
    throw std::invalid_argument("there are more poses than readings");
  parts_->finish();
}

bool Learner::step() {
  Parts& parts = *parts_;
  if (parts.isOver) return false;
  const std::vector<Stop> stops =
      parts.helpers.empty() ? parts.stepAlone() : parts.stepWithHelpers();
  for (const Stop& stop : stops) parts.done += stop.sweep->readingsACell();
  if (!stops.empty())
    parts.pose = {parts.region.grid.centreX(stops.back().cell),
                  parts.region.grid.centreY(stops.back().cell), 0.0};
  return !parts.isOver;
}

double Learner::share() const {
  if (parts_->isOver) return 1.0;
  // A shard has whole stops, so it may make some readings more than its share.
  return std::min(1.0, static_cast<double>(parts_->done) /
                           static_cast<double>(std::max<std::size_t>(parts_->total, 1)));
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
