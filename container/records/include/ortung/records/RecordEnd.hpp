#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "ortung/base/Export.hpp"

namespace ortung {

/// The part at the end of a record that is left out since its writer died: all that follows the
/// last whole moment, or the last whole chunk of a compressed record.
struct TornRecord {
  std::uintmax_t begin = 0;  ///< offset of the torn part in the file [bytes]
  std::uintmax_t bytes = 0;  ///< size of the torn part [bytes]
};

/// Returns the torn end of a record file, or nothing if the file is whole.
/// @throws std::runtime_error if it can't be read
ORTUNG_API std::optional<TornRecord> tornEnd(const std::filesystem::path& file);

/// Cuts off what tornEnd() finds, and returns it.
/// @throws std::runtime_error if the file can't be written, or another process is writing it
ORTUNG_API std::optional<TornRecord> mendRecord(const std::filesystem::path& file);

}  // namespace ortung
