#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "ortung/core/PluginFactory.hpp"

namespace ortung::app {

/// What a library offers, and the help of its players and sources by lines: what it is, then its
/// options.
struct Offer {
  PluginFactory::Found found;
  std::map<std::string, std::vector<std::string>> help;  ///< lines of help by plugin
};

/// Returns what a library offers, whatever its code does when it is loaded: a child process does
/// it.
/// @param timeout longest time to load it [s]
Offer lookAt(const std::filesystem::path& library, double timeout);

/// What that child process does: loads a library and writes its offer to standard output, to which
/// the library's code can't write. Loading may hang, so a thread watches it.
[[noreturn]] void describeOffer(const std::filesystem::path& library, double timeout);

/// Returns the kind of an interface: that of "ortung.Source/0.2.0-3f2a" is "Source".
std::string kindOf(const std::string& interface);

}  // namespace ortung::app
