#pragma once

#include <filesystem>

#include "Learn.hpp"
#include "PartSet.hpp"
#include "Shard.hpp"

namespace ortung::app {

inline constexpr const char* kLearnParts = "learn";  ///< kind of the parts

/// Generates the readings of a shard and writes them as a part.
void learnShard(const LearnArguments& arguments, const Shard& shard,
                const std::filesystem::path& out);

/// Learns the readings of all parts, and writes the tables, with the same bits as if one process
/// had done all of the work. Reads world and robot file again. @throws PartError if they are others
/// than those of the parts
void mergeLearned(const PartSet& parts, const std::filesystem::path& out, bool progress);

}  // namespace ortung::app
