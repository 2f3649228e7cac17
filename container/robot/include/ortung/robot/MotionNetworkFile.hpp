#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "ortung/motion/MotionNetwork.hpp"

namespace ortung {

/// Reads a file of toJson(). @throws ConfigError naming file, place, found, expected
ORTUNG_API MotionNetwork readMotionNetwork(const std::filesystem::path& file);
/// @param name what errors call it
ORTUNG_API MotionNetwork parseMotionNetwork(std::string_view text, const std::string& name);
ORTUNG_API std::string toJson(const MotionNetwork& network);

}  // namespace ortung
