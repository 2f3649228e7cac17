#pragma once

#include <optional>
#include <string>

#include "Participant.hpp"
#include "ortung/core/SensorContainer.hpp"
#include "ortung/ros2/Messages.hpp"
#include "ortung/tables/Building.hpp"

namespace ortung::ros2 {

/// Tells the robot's floor, at the topic `floor` and on the terminal, whenever it is another one.
/// Not thread-safe.
class FloorSpeech {
 public:
  /// @param floor its name; "": it is not known, or there are none
  /// @param isActive whether topics are told
  void tell(const std::string& floor, Participant& node, bool isActive);

 private:
  Participant::Sender send_;  ///< null until a floor is told
  std::string told_;          ///< floor that the topic had last
  std::string said_;          ///< floor that the terminal had last
};

/// Returns the samples on a floor that were published last, in its own frame and with weights of
/// sum 1; nothing if there are none. @param floor nothing: all samples, as they are
std::optional<ParticleCloud> particlesOn(const std::optional<Floor>& floor,
                                         const SensorContainer& container, const Header& header);

}  // namespace ortung::ros2
