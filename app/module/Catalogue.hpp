#pragma once

#include <span>
#include <string_view>

namespace ortung::app {

/// A command of the program, whether or not its module is installed. CMake makes the list of what
/// `ortung_command` is told.
struct CatalogueEntry {
  const char* name;     ///< "learn", "export map"
  const char* summary;  ///< what it is for
  const char* module;   ///< which holds it
  const char* package;  ///< of Debian, which holds the module
};

/// Commands that begin with the same word.
struct CatalogueGroup {
  const char* name;
  const char* summary;
  const char* example;
};

std::span<const CatalogueEntry> catalogue();
std::span<const CatalogueGroup> catalogueGroups();

/// @throws std::logic_error if there is none
const CatalogueEntry& commandNamed(std::string_view name);
const CatalogueGroup& groupNamed(std::string_view name);

}  // namespace ortung::app
