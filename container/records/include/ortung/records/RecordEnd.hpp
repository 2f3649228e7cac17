#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "ortung/base/Export.hpp"

namespace ortung {

/// What is left out at the end of a record whose writer died: what follows its last whole moment,
/// or of a compressed one its last whole chunk.
struct TornRecord {
  std::uintmax_t begin = 0;  ///< bytes before it
  std::uintmax_t bytes = 0;
};

/// What a record file ends in that is not whole, or nothing.
/// @throws std::runtime_error if it can't be read
ORTUNG_API std::optional<TornRecord> tornEnd(const std::filesystem::path& file);

/// Cuts off what tornEnd() finds, and says what that was.
/// @throws std::runtime_error if the file can't be written, or is being written by somebody
ORTUNG_API std::optional<TornRecord> mendRecord(const std::filesystem::path& file);

}  // namespace ortung
