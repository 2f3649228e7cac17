#pragma once

#include <filesystem>
#include <string>

namespace ortung {

/// Returns the text of a TOML file as it is on the disk. @throws ConfigError
std::string readUnchanged(const std::filesystem::path& file);

/// Returns the text of a file with the changes that changeToml() has made. @throws ConfigError
std::string changedToml(std::string text, const std::filesystem::path& file);

}  // namespace ortung
