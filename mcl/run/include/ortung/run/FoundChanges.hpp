#pragma once

#include <filesystem>
#include <string>

#include "ortung/base/Export.hpp"
#include "ortung/formats/ChangesData.hpp"

namespace ortung {

/// Where a localization has found that a map no longer fits.
struct FoundChanges {
  ChangesData::Reading changes;
  std::string worldFingerprint;  ///< of the world that the map is of; "": not known
};

/// Reads them from a belief that was saved (Localization::saveBelief), or from the newest reading
/// of mcl/LOCALIZATION/map in a record.
/// @throws TableError, std::runtime_error naming the file and what is wrong with it, also if it is
///   a record without such a reading
ORTUNG_API FoundChanges readFoundChanges(const std::filesystem::path& file);

}  // namespace ortung
