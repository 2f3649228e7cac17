#pragma once

#include <filesystem>

#include "PartSet.hpp"
#include "ortung/benchmark/GoalMatrix.hpp"

namespace ortung::app {

inline constexpr const char* kGoalkeeperParts = "goalkeeper";  ///< kind of the parts

/// Writes the episodes of a shard as a part.
void write(const GoalMatrix& shard, PartHead head, const std::filesystem::path& file);

/// Returns the matrix of all parts. @throws PartError
GoalMatrix mergeMatrices(const PartSet& parts);

}  // namespace ortung::app
