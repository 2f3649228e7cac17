#pragma once

#include <span>
#include <string>
#include <vector>

#include "ortung/core/SensorData.hpp"
#include "ortung/robot/RobotFile.hpp"
#include "ortung/robot/RobotText.hpp"
#include "ortung/study/NoiseLearner.hpp"

namespace ortung::app {

/// What was learned of a device, with standard errors, as lines for people.
std::string noiseText(std::span<SensorData* const> features, const LearnedNoise& noise);

/// The keys of a [[sensor]] that say it: sigmas, outliers, and the terms that are known, added to
/// what the robot file says of them. None of plugins that have other keys. Biases and a latency
/// have no key.
std::vector<TomlEntry> noiseEntries(const SensorConfig& sensor, const LearnedNoise& noise);

}  // namespace ortung::app
