#pragma once

#include <span>
#include <string>
#include <string_view>

#include "ortung/robot/RobotFile.hpp"

namespace ortung {

/// Reads a robot file that comes from an untrusted client: at most kMaxNetworkConfigBytes, plugins
/// of a list only, nothing that could name a file of this computer (no text with a slash, no key
/// `path`, `file`,
/// `..._path` or `..._file`), and at most 32 pieces of geometry in all states together, of which an
/// ellipse that is no circle counts 8. [motion] and [mcl] are for the client's own half, may say
/// what they like, and come out empty.
/// @param name what errors call it
/// @param plugins names that are permitted
/// @throws ConfigError
ORTUNG_API RobotConfig readNetworkRobot(std::string_view toml, const std::string& name,
                                        std::span<const std::string> plugins);

}  // namespace ortung
