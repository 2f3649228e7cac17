#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/core/SensorContainer.hpp"
#include "ortung/mcl/MclConfig.hpp"
#include "ortung/motion/MotionModel.hpp"

namespace ortung {

/// Notices devices that repeat their readings word for word though the robot moves: they hang, or
/// their driver does, and new stamps hide it. Noise never repeats many words. Fewer may repeat by
/// chance, those of rings of distances beside a wall above all, so there a longer way is asked for,
/// and all features of a device (the same model and type) count together. Not thread-safe.
class ORTUNG_API FrozenDevices {
 public:
  /// @param motion borrowed; knows odometry
  FrozenDevices(const MclConfig& config, const MotionModel& motion)
      : config_(config), motion_(motion) {}

  /// Takes what the features read. @pre the container's read lock is held
  void look(const SensorContainer& container);
  /// Returns whether the feature's readings repeat themselves.
  bool has(const SensorData& data) const;
  /// Returns a feature whose readings repeat themselves; null: none.
  const SensorData* first() const { return first_; }
  void forget();

 private:
  /// The words of a feature, and where the robot was when they first came.
  struct Words {
    std::size_t device = 0;  ///< index of its device
    std::uint64_t sequence = 0;
    std::uint64_t hash = 0;
    std::optional<Pose2> odometry;
    bool isFrozen = false;
  };
  /// Features of one device, since the first one of them changed last.
  struct Device {
    std::optional<Pose2> from;             ///< odometry then
    std::set<const SensorData*> repeated;  ///< features that came again, with the same words
    std::optional<Pose2> to;               ///< odometry when one of them did last
    bool isFrozen = false;
  };
  Words& wordsOf(const SensorData& data);
  void take(const SensorData& data);
  bool hasRepeatedEnough(const Device& device) const;

  const MclConfig& config_;
  const MotionModel& motion_;
  std::map<const SensorData*, Words> words_;
  std::map<std::pair<std::string, std::string>, std::size_t> numbers_;  ///< by model and type
  std::vector<Device> devices_;
  const SensorData* first_ = nullptr;
};

}  // namespace ortung
