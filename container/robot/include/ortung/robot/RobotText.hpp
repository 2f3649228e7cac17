#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "ortung/base/Export.hpp"

namespace ortung {

/// A key and the TOML of its value.
using TomlEntry = std::pair<std::string, std::string>;

/// Returns the text of a robot file with other values for keys of one [[sensor]]. All else stays as
/// it is, comments, too; a key that was not there comes behind `plugin`.
/// @param name what errors call the file
/// @param sensor number of the [[sensor]] in the file, from 0
/// @throws ConfigError if the text is no robot file, has no such sensor, or has it in a form that
///   can't be changed in place (within one line of braces)
ORTUNG_API std::string withSensorKeys(std::string_view text, const std::string& name,
                                      std::size_t sensor, std::span<const TomlEntry> entries);

}  // namespace ortung
