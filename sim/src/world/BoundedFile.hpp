#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace ortung {

/// Reads a whole regular file. @throws MapError if it is missing, not a regular file, or larger
/// than @p maxBytes
std::string readBounded(const std::filesystem::path& file, std::size_t maxBytes);

/// Reads a whole regular file and unpacks .gz and .xz; @p maxBytes holds before and after
/// unpacking. @throws MapError if it is missing, not a regular file, damaged or too large
std::string readUnpacked(const std::filesystem::path& file, std::size_t maxBytes);

}  // namespace ortung
