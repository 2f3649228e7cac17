#pragma once

#include <string_view>

namespace ortung::app {

/// Returns what a plugin that ships with the program is, for who looks for one; "" for others.
/// @param kind as `ortung plugins` calls it: "sensor", "motion", "drive", "referee", "device"
std::string_view sentenceOf(std::string_view kind, std::string_view name);

}  // namespace ortung::app
