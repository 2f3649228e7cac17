#pragma once

#include <filesystem>
#include <string>

#include "ortung/mcl/Belief.hpp"
#include "ortung/robot/TableInfo.hpp"

namespace ortung {

/// Writes a belief in the format of table files: arrays x, y, theta, logWeight and stamp_us, and
/// the fingerprint of the world as the text world.txt. The file appears whole or not at all.
/// @throws TableError
void writeBelief(const std::filesystem::path& file, const Belief& belief,
                 const std::string& worldFingerprint);

/// Reads what writeBelief() wrote in the same world.
/// @throws TableError naming the file and what is wrong with it: torn, numbers that can't be,
///   another world than that of @p tables, no sample where the robot can stand
Belief readBelief(const std::filesystem::path& file, const TableInfo& tables);

}  // namespace ortung
