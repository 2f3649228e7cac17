#pragma once

#include "Catalogue.hpp"
#include "CommandModule.hpp"

namespace ortung::app {

/// Opens a command's module, which stays open. It is searched in the folders of
/// $ORTUNG_COMMAND_PATH if that is set, else in ortung/commands beside libortung_container.so.
/// @throws std::runtime_error saying which package has it if it is not installed, or that it is of
///         another version than this program
CommandModule loadModule(const CatalogueEntry& command);

/// Returns whether the command's module exists, without opening it.
bool isInstalled(const CatalogueEntry& command);

}  // namespace ortung::app
