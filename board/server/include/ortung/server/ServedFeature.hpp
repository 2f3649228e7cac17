#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/core/SensorContainer.hpp"

namespace ortung {

/// Number by which clients name a robot; never used again within one server. 0: the world itself.
using RobotId = std::uint32_t;

/// One feature of a robot that takes part.
struct ServedFeature {
  SensorId id;
  std::string wordsHelp;    ///< one line on what the words mean, for people
  Pose2 mount = {};         ///< the sensor's pose in the robot frame
  std::string format = {};  ///< Format::toText(); "": it is not known
};

/// The features of a container.
ORTUNG_API std::vector<ServedFeature> servedFeatures(const SensorContainer& container);

/// As in readings of robot 0: [1/100 degree], in [0, 36000).
ORTUNG_API std::uint32_t headingWord(double radians);

/// A robot's words of `world/truth/robots` of robot 0: number, x, y, heading, and the states of its
/// manipulators, four bits each.
ORTUNG_API std::array<std::uint32_t, 5> robotWords(RobotId robot, const Pose2& poseInField,
                                                   std::uint32_t states);

}  // namespace ortung
