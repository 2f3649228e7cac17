#pragma once

#include <filesystem>
#include <string>

#include "ortung/mcl/Belief.hpp"
#include "ortung/mcl/MapChanges.hpp"
#include "ortung/robot/TableInfo.hpp"
#include "ortung/tables/TableFile.hpp"

namespace ortung {

/// What a localization has found out, as it is kept between two runs.
struct SavedBelief {
  Belief belief;
  MapChanges changes;  ///< where the map no longer fits
};

/// Writes a belief in the format of table files: arrays x, y, theta, logWeight and stamp_us, if
/// there are any the changes of the map (a row of kind, column, row, passes, lately, against, days,
/// last day, sign of being sure a cell, and one of its middle), and the fingerprint of the world as
/// the text world.txt. The file appears whole or not at all. @throws TableError
void writeBelief(const std::filesystem::path& file, const SavedBelief& saved,
                 const std::string& worldFingerprint);

/// Reads what writeBelief() wrote in the same world.
/// @throws TableError naming the file and what is wrong with it: torn, numbers that can't be,
///   another world than that of @p tables, no sample where the robot can stand
SavedBelief readBelief(const std::filesystem::path& file, const TableInfo& tables);

/// Returns the changes of the map in a belief; files of older versions have none.
/// @throws TableError naming the file and what is wrong with it
MapChanges changesIn(const TableFile& file);
/// Returns the fingerprint of the world that a belief is about. @throws TableError
std::string worldIn(const TableFile& file);

}  // namespace ortung
