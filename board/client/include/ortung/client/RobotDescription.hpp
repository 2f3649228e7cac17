#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/core/SensorContainer.hpp"

namespace ortung {

/// A robot's parameters as its server reports them (paper, section 3): poses of sensors, greatest
/// velocities, and commands that it takes. Parameters that the server does not know are empty: for
/// a record it knows the features alone.
struct ORTUNG_API RobotDescription {
  /// One feature of the robot, whose readings the server sends.
  struct Feature {
    SensorId id;
    std::string words;           ///< what the words of its readings mean, for people
    std::optional<Pose2> mount;  ///< the sensor's pose in the robot frame
    /// What they mean, for programs; nothing if the server does not know.
    std::optional<Format> format = {};
  };
  /// A part of the robot with named states, such as a kicker.
  struct Manipulator {
    std::string name;
    std::vector<std::string> states;  ///< it begins in the first
  };

  std::vector<Feature> features;
  std::string motion;      ///< what the numbers of setMotion() mean, for people
  std::string motionKind;  ///< its kind for programs, as Drive names it; "": not known
  std::optional<double> maxTranslationalVelocity;      ///< [m/s]
  std::optional<double> maxRotationalVelocity;         ///< [rad/s]
  std::optional<double> maxTranslationalAcceleration;  ///< [m/s^2]
  std::optional<double> maxRotationalAcceleration;     ///< [rad/s^2]
  std::optional<double> radius;                        ///< radius of the circle around the body [m]
  std::optional<double> height;                        ///< [m]
  std::optional<double> mass;                          ///< [kg]
  std::vector<Manipulator> manipulators;

  /// The first feature that @p query matches, or null.
  const Feature* find(const SensorQuery& query) const;
};

/// Reads the lines that DESCRIBE robot gives. Kinds of lines that it does not know are passed over.
/// @throws std::invalid_argument with the line that can't be one of its kind
ORTUNG_API RobotDescription parseRobotDescription(const std::vector<std::string>& lines);

}  // namespace ortung
