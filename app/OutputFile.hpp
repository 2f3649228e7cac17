#pragma once

#include <filesystem>
#include <span>
#include <string_view>

namespace ortung::app {

/// Whether the file can be written later on, asked before long work begins.
/// @throws std::runtime_error naming the file if its folder is missing or closed to us
void checkOutput(const std::filesystem::path& file);

/// Puts a whole file in place: the old one stays until the new one is complete on the disk.
/// @throws std::runtime_error naming the file and the reason
void writeFile(const std::filesystem::path& file, std::span<const std::byte> bytes);
void writeFile(const std::filesystem::path& file, std::string_view text);

}  // namespace ortung::app
