#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "ortung/core/SensorContainer.hpp"
#include "ortung/study/PoseBound.hpp"

namespace ortung::app {

/// How good estimates can be of a run in a world that is known exactly: asks the robot's simulated
/// sensors without noise what they read at the true pose and around it, and how much noise there
/// was from the readings themselves. Not thread-safe.
class SimulatedBound {
 public:
  /// @throws ConfigError, PluginError
  SimulatedBound(const std::filesystem::path& world, const std::filesystem::path& robot);
  ~SimulatedBound();
  SimulatedBound(const SimulatedBound&) = delete;
  SimulatedBound& operator=(const SimulatedBound&) = delete;

  /// Takes the newest readings of the robot, of the moment at which it is at @p truth.
  void look(const SensorContainer& container, Timestamp stamp, const std::optional<Pose2>& truth);

  /// All moments with readings and truth, with what their readings tell.
  std::vector<BoundStep> steps() const;
  /// The bound of all of them.
  std::vector<PoseBound> bounds() const { return poseBound(steps()); }

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace ortung::app
