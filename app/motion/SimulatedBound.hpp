#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "ortung/core/SensorContainer.hpp"
#include "ortung/study/PoseBound.hpp"

namespace ortung::app {

/// Bound of the errors of estimates of a run in a world that is known exactly. It simulates the
/// robot's sensors without noise at the true pose and around it, and estimates the noise from the
/// readings. Not thread-safe.
class SimulatedBound {
 public:
  /// @throws ConfigError, PluginError
  SimulatedBound(const std::filesystem::path& world, const std::filesystem::path& robot);
  ~SimulatedBound();
  SimulatedBound(const SimulatedBound&) = delete;
  SimulatedBound& operator=(const SimulatedBound&) = delete;

  /// Takes the newest readings of the robot, which is at @p truth at that time.
  void look(const SensorContainer& container, Timestamp stamp, const std::optional<Pose2>& truth);

  /// Returns all times with readings and truth, with the information of their readings.
  std::vector<BoundStep> steps() const;
  /// Returns the bound at all of these times.
  std::vector<PoseBound> bounds() const { return poseBound(steps()); }

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace ortung::app
