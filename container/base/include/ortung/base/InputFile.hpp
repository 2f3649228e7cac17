#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"

namespace ortung {

/// Opens a file to read it, and notes that this process reads it: see isInput().
/// @param why gets the reason where that is not possible; the stream has failed then
/// Thread-safe, like all functions of this header.
ORTUNG_API std::ifstream openInput(const std::filesystem::path& file, std::string& why);

/// Returns why a file can't be read, for messages: "can't be read: Permission denied".
/// @param error value of errno
ORTUNG_API std::string cantBeRead(int error);

/// Notes a file that is read by other means than openInput().
ORTUNG_API void noteInput(const std::filesystem::path& file);

/// Returns whether this process has read that very file, by whatever name or link. Devices and
/// pipes do not count.
ORTUNG_API bool isInput(const std::filesystem::path& file);

/// Returns all files that this process has read by now, in no order, by the names with which it
/// read them first. Devices and pipes do not count.
ORTUNG_API std::vector<std::filesystem::path> allInputs();

}  // namespace ortung
