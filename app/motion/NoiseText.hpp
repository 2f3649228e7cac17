#pragma once

#include <span>
#include <string>
#include <vector>

#include "ortung/core/SensorData.hpp"
#include "ortung/robot/RobotFile.hpp"
#include "ortung/robot/RobotText.hpp"
#include "ortung/study/NoiseLearner.hpp"

namespace ortung::app {

/// Returns what was learned about a device, with standard errors, as lines for users.
std::string noiseText(std::span<SensorData* const> features, const LearnedNoise& noise);

/// Returns it as keys of a [[sensor]]: sigmas, outliers, and the terms that are known, added to the
/// values of the robot file. None for plugins with other keys. Biases and a latency have no key.
std::vector<TomlEntry> noiseEntries(const SensorConfig& sensor, const LearnedNoise& noise);

}  // namespace ortung::app
