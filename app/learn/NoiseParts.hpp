#pragma once

#include <cstddef>
#include <filesystem>
#include <utility>
#include <vector>

#include "PartSet.hpp"
#include "ortung/study/NoiseLearner.hpp"

namespace ortung::app {

inline constexpr const char* kNoiseParts = "noise";  ///< kind of the parts

/// What a shard of `ortung calibrate noise` has read: sources by their numbers.
using NoisePart = std::vector<std::pair<std::size_t, NoiseLog>>;

/// Writes readings and poses of a shard's sources as a part.
void write(const NoisePart& part, PartHead head, const std::filesystem::path& file);

/// Returns the logs of all parts in the order of the sources.
/// @throws PartError, TableError
std::vector<NoiseLog> mergeNoiseLogs(const PartSet& parts);

}  // namespace ortung::app
