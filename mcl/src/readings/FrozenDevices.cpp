#include "FrozenDevices.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>

#include "Moved.hpp"
#include "ReadingsTuning.hpp"

namespace ortung {
namespace {

using namespace tuning::frozen;

/// A reading of at least this many words never repeats itself at random while its device works,
/// because of its noise.
constexpr std::size_t kManyWords = 16;

/// FNV-1a (Fowler, Noll, Vo), a word at a time.
std::uint64_t hashOf(std::span<const std::uint32_t> words) {
  std::uint64_t hash = 14695981039346656037ULL;
  for (const std::uint32_t word : words) hash = (hash ^ word) * 1099511628211ULL;
  return hash;
}

/// All words are equal if nothing is in sight, and then do not change.
bool areMany(std::span<const std::uint32_t> words) {
  return words.size() >= kManyWords &&
         std::adjacent_find(words.begin(), words.end(), std::not_equal_to<>()) != words.end();
}

}  // namespace

void FrozenDevices::look(const SensorContainer& container) {
  for (const auto& data : container.all())
    if (data->localizes() && data->sequence() > 0) take(*data);
  first_ = nullptr;
  for (Device& device : devices_) device.isFrozen = device.isFrozen || hasRepeatedEnough(device);
  for (const auto& data : container.all())
    if (first_ == nullptr && has(*data)) first_ = data.get();
}

bool FrozenDevices::has(const SensorData& data) const {
  const auto it = words_.find(&data);
  return it != words_.end() && (it->second.isFrozen || devices_[it->second.device].isFrozen);
}

void FrozenDevices::forget() {
  words_.clear();
  numbers_.clear();
  devices_.clear();
  first_ = nullptr;
}

FrozenDevices::Words& FrozenDevices::wordsOf(const SensorData& data) {
  const auto [it, isNew] = words_.try_emplace(&data);
  if (isNew) {
    const SensorId& id = data.id();
    it->second.device = numbers_.try_emplace({id.model, id.type}, devices_.size()).first->second;
    devices_.resize(std::max(devices_.size(), it->second.device + 1));
  }
  return it->second;
}

void FrozenDevices::take(const SensorData& data) {
  Words& known = wordsOf(data);
  if (data.sequence() == known.sequence) return;
  const std::span<const std::uint32_t> words = data.getData();
  const std::optional<Pose2> odometry = motion_.odometryAt(data.stamp());
  const std::uint64_t hash = hashOf(words);
  const bool isRepeated = known.sequence != 0 && hash == known.hash && known.odometry && odometry;
  Device& device = devices_[known.device];
  if (isRepeated) {
    device.repeated.insert(&data);
    device.to = odometry;
    if (areMany(words) && hasMoved(config_, *known.odometry, *odometry)) known.isFrozen = true;
    known.sequence = data.sequence();
  } else {
    device = {odometry, {}, odometry, false};
    known = {known.device, data.sequence(), hash, odometry, false};
  }
}

/// A turn alone does not count, since distances to posts stay the same meanwhile.
bool FrozenDevices::hasRepeatedEnough(const Device& device) const {
  if (!device.from || !device.to ||
      distance(*device.from, *device.to) < kTimesFarther * config_.minDistance)
    return false;
  std::set<std::uint32_t> different;
  for (const SensorData* data : device.repeated) {
    const std::span<const std::uint32_t> words = data->getData();
    different.insert(words.begin(), words.end());
  }
  return different.size() >= static_cast<std::size_t>(kFewWords);
}

}  // namespace ortung
