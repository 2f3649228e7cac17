#include "ortung/mcl_served/LocalizedWorld.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "Orders.hpp"
#include "ortung/run/Localization.hpp"

namespace ortung {
namespace {

const std::string kAll = "all";

bool has(const std::vector<SensorId>& ids, const SensorId& id) {
  return std::find(ids.begin(), ids.end(), id) != ids.end();
}

std::vector<ServedFeature> publishedFeatures() {
  SensorContainer container;
  addPublishedFeatures(container);
  return servedFeatures(container);
}

bool isOfFilter(const SensorId& id) { return id.model == "mcl" && id.type == "LOCALIZATION"; }

}  // namespace

LocalizedWorld::LocalizedWorld(ServedWorld& world, Config config)
    : ForwardedWorld(world), config_(std::move(config)), features_(publishedFeatures()) {
  checkNames();
  meetResidents();
}

LocalizedWorld::~LocalizedWorld() = default;

void LocalizedWorld::checkNames() const {
  const std::vector<Resident> residents = world().residents();
  for (const std::string& name : config_.names) {
    if (name == kAll) continue;
    const auto found = std::find_if(residents.begin(), residents.end(),
                                    [&](const Resident& one) { return one.name == name; });
    if (found == residents.end()) throw std::invalid_argument("there is no robot '" + name + "'");
    if (config_.robotFile(found->robot).empty())
      throw std::invalid_argument("the robot '" + name + "' has no features to localize by");
  }
}

bool LocalizedWorld::isNamed(const std::string& name) const {
  return std::any_of(config_.names.begin(), config_.names.end(),
                     [&](const std::string& one) { return one == name || one == kAll; });
}

/// Robots of the world's own come and go.
void LocalizedWorld::meetResidents() {
  std::erase_if(leaving_, [](const auto& thread) { return thread->isOver(); });
  const std::uint64_t version = world().residentsVersion();
  if (version_ == version) return;
  version_ = version;
  const std::vector<Resident> residents = world().residents();
  const std::lock_guard lock(mutex_);
  for (auto entry = filters_.begin(); entry != filters_.end();) {
    const bool isThere = std::any_of(residents.begin(), residents.end(), [&](const Resident& one) {
      return one.robot == entry->first;
    });
    if (isThere) {
      ++entry;
      continue;
    }
    if (entry->second.thread) {
      entry->second.thread->requestStop();
      leaving_.push_back(std::move(entry->second.thread));
    }
    entry = filters_.erase(entry);
  }
  for (const Resident& resident : residents) {
    if (filters_.contains(resident.robot) || config_.robotFile(resident.robot).empty()) continue;
    Filter& filter = filters_[resident.robot];
    if (isNamed(resident.name))
      threadOf(resident.robot, filter).order({LocalizationOrder::Kind::kOn});
  }
}

/// @pre mutex_ is locked
FilterThread& LocalizedWorld::threadOf(RobotId robot, Filter& filter) {
  if (filter.thread) return *filter.thread;
  filter.thread = std::make_unique<FilterThread>(
      FilterThread::Config{config_.robotFile(robot), config_.tables, config_.seed + robot});
  filter.thread->wantSamples(has(filter.wanted, samplesId()));
  return *filter.thread;
}

LocalizedWorld::Filter& LocalizedWorld::filter(RobotId robot) {
  meetResidents();
  const auto found = filters_.find(robot);
  if (found == filters_.end())
    throw ServeError("no-robot", "there is no robot " + std::to_string(robot) +
                                     " of the world's own that has features to localize by");
  return found->second;
}

// --- LocalizedRobots

std::optional<RobotId> LocalizedWorld::usual() const {
  const std::lock_guard lock(mutex_);
  if (filters_.size() != 1) return std::nullopt;
  return filters_.begin()->first;
}

LocalizationState LocalizedWorld::state(RobotId robot) {
  const Filter& its = filter(robot);
  return its.thread ? its.thread->state() : LocalizationState();
}

void LocalizedWorld::order(RobotId robot, const LocalizationOrder& order) {
  Filter& its = filter(robot);
  const std::lock_guard lock(mutex_);
  if (its.thread || order.kind != LocalizationOrder::Kind::kOff) threadOf(robot, its).order(order);
}

std::shared_ptr<const Robot> LocalizedWorld::perceiver(RobotId robot) const {
  const std::lock_guard lock(mutex_);
  const auto found = filters_.find(robot);
  const FilterThread* thread = found == filters_.end() ? nullptr : found->second.thread.get();
  std::shared_ptr<const Robot> perceiver = thread != nullptr ? thread->perceiver() : nullptr;
  if (!perceiver)
    throw ServeError(
        "state", "robot " + std::to_string(robot) + " is not localized here; LOCALIZE robot=N on");
  return perceiver;
}

// --- ServedWorld

void LocalizedWorld::step() {
  world().step();
  meetResidents();
  for (auto& [robot, its] : filters_) {
    if (!its.thread) continue;
    std::vector<SensorId> needs = its.thread->needs();
    if (needs == its.needs) continue;
    its.needs = std::move(needs);
    tellWanted(robot, its);
  }
}

/// What clients ask for, and what the filter looks at.
void LocalizedWorld::tellWanted(RobotId robot, const Filter& filter) {
  std::vector<SensorId> all = filter.needs;
  for (const SensorId& id : filter.wanted)
    if (!isOfFilter(id) && !has(all, id)) all.push_back(id);
  world().want(robot, all);
}

void LocalizedWorld::want(RobotId robot, std::span<const SensorId> features) {
  const auto found = filters_.find(robot);
  if (found == filters_.end()) return world().want(robot, features);
  Filter& its = found->second;
  its.wanted.assign(features.begin(), features.end());
  if (its.thread) its.thread->wantSamples(has(its.wanted, samplesId()));
  tellWanted(robot, its);
}

std::vector<Resident> LocalizedWorld::residents() const {
  std::vector<Resident> residents = world().residents();
  for (Resident& resident : residents)
    if (!config_.robotFile(resident.robot).empty())
      resident.features.insert(resident.features.end(), features_.begin(), features_.end());
  return residents;
}

std::span<Message> LocalizedWorld::readings(RobotId robot) {
  const std::span<Message> frame = world().readings(robot);
  const auto found = filters_.find(robot);
  if (found == filters_.end() || !found->second.thread) return frame;
  FilterThread& thread = *found->second.thread;
  thread.take(frame);
  frame_.clear();
  thread.takePublished(frame_);
  if (frame_.empty()) return frame;
  const auto published = static_cast<std::ptrdiff_t>(frame_.size());
  for (Message& message : frame)
    frame_.push_back({message.stamp, message.id, std::move(message.words)});
  std::rotate(frame_.begin(), frame_.begin() + published, frame_.end());
  return frame_;
}

std::vector<Message> LocalizedWorld::lateReadings(RobotId robot) {
  std::vector<Message> late = world().lateReadings(robot);
  const auto found = filters_.find(robot);
  if (found != filters_.end() && found->second.thread) found->second.thread->takePublished(late);
  return late;
}

void LocalizedWorld::reset(std::optional<std::uint64_t> seed) {
  world().reset(seed);
  restartFilters();
}

void LocalizedWorld::seek(Timestamp stamp) {
  world().seek(stamp);
  restartFilters();
}

void LocalizedWorld::restartFilters() {
  meetResidents();
  for (auto& [robot, its] : filters_) {
    its.needs.clear();  // its sensors are new ones
    if (its.thread) its.thread->restart();
  }
}

}  // namespace ortung
