#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "ortung/base/Parameters.hpp"

namespace ortung {

/// Most bytes of a file from disk: 65,536 primitives.
inline constexpr std::size_t kMaxConfigBytes = 8u << 20;
/// Most bytes of a text from the network.
inline constexpr std::size_t kMaxNetworkConfigBytes = 64u << 10;

/// Reads a TOML file into Parameters whose errors name file and line.
/// @throws ConfigError if it is missing, too large, nested too deep or no TOML
ORTUNG_API Parameters readToml(const std::filesystem::path& file);

/// Returns the text of a TOML file, unparsed. @throws ConfigError if it is missing or too large
ORTUNG_API std::string readTomlText(const std::filesystem::path& file);

/// Changes a value of a TOML file for this process: all that read the file from now on get the
/// changed text, as if somebody had edited it. The file itself stays as it is. Thread-safe.
/// @param key dotted path, as "mcl.particles"; in a list of tables, as [[sensor]], the second word
///   is their number, from 1, or the value of their key `plugin`, `model` or `type`:
///   "sensor.lrf.range_sigma_m" changes all of that plugin
/// @param value TOML, as "500" or "true"; what is no TOML is a text
/// @throws ConfigError naming the key if the file can't be read, or has no such table or list
ORTUNG_API void changeToml(const std::filesystem::path& file, const std::string& key,
                           const std::string& value);

/// Reads TOML text. @param name what errors call it @throws ConfigError
ORTUNG_API Parameters parseToml(std::string_view text, const std::string& name,
                                std::size_t maxBytes = kMaxConfigBytes);

/// Returns TOML text without some tables of arrays, [[name]]. Comments are lost.
/// @param name what errors call the text @param isLeftOut is asked for each table, with the array's
///   name
/// @throws ConfigError as parseToml()
ORTUNG_API std::string withoutTables(
    std::string_view text, const std::string& name,
    const std::function<bool(const std::string&, const Parameters&)>& isLeftOut);

}  // namespace ortung
