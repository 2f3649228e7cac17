#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "ortung/motion/MotionNetwork.hpp"

namespace ortung {

/// Reads a network file, see toJson(). @throws ConfigError naming file, place, found, expected
ORTUNG_API MotionNetwork readMotionNetwork(const std::filesystem::path& file);
/// Reads the text of such a file. @param name what errors call it @throws ConfigError
ORTUNG_API MotionNetwork parseMotionNetwork(std::string_view text, const std::string& name);
/// Returns the text of a network file, which parseMotionNetwork() reads back.
ORTUNG_API std::string toJson(const MotionNetwork& network);

}  // namespace ortung
