#pragma once

#include <span>
#include <string_view>

namespace ortung::app {

/// A command of the program, whether or not its module is installed. CMake makes the list from the
/// calls of `ortung_command`.
struct CatalogueEntry {
  const char* name;     ///< its name, e.g. "learn", "export map"
  const char* summary;  ///< its purpose
  const char* module;   ///< the module that has it
  const char* package;  ///< Debian package of the module
  const char* section;  ///< heading under which `ortung --help` lists it
};

/// A group of commands that begin with the same word.
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
