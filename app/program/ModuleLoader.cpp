#include "ModuleLoader.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "ortung/base/LibraryFolder.hpp"

namespace ortung::app {
namespace {

std::vector<std::filesystem::path> folders() {
  const char* variable = std::getenv("ORTUNG_COMMAND_PATH");
  if (variable == nullptr) return {libraryFolder() / "ortung/commands"};
  std::vector<std::filesystem::path> folders;
  std::istringstream all(variable);
  for (std::string folder; std::getline(all, folder, ':');) folders.emplace_back(folder);
  return folders;
}

std::string foldersText() {
  std::string text;
  for (const std::filesystem::path& folder : folders())
    text += (text.empty() ? "" : ":") + folder.string();
  return text;
}

/// Returns the module's file; "" if there is none.
std::filesystem::path fileOf(const CatalogueEntry& command) {
  std::error_code error;
  for (const std::filesystem::path& folder : folders()) {
    auto file = folder / fmt::format("ortung_command_{}.so", command.module);
    if (std::filesystem::exists(file, error)) return file;
  }
  return {};
}

}  // namespace

bool isInstalled(const CatalogueEntry& command) { return !fileOf(command).empty(); }

CommandModule loadModule(const CatalogueEntry& command) {
  const std::filesystem::path file = fileOf(command);
  if (file.empty())
    throw std::runtime_error(
        fmt::format("the command '{}' is not installed: it is in the package {} (there is no "
                    "ortung_command_{}.so in {})",
                    command.name, command.package, command.module, foldersText()));
  void* library = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    const char* why = ::dlerror();
    throw std::runtime_error(fmt::format("the command '{}' of the package {} can't be loaded: {}",
                                         command.name, command.package,
                                         why == nullptr ? "no reason is given" : why));
  }
  void* symbol = ::dlsym(library, kCommandModuleSymbol);
  if (symbol == nullptr)
    throw std::runtime_error(fmt::format("{}: is not a command of ortung, it has no {}",
                                         file.string(), kCommandModuleSymbol));
  const CommandModule module = reinterpret_cast<CommandModule (*)()>(symbol)();
  if (std::strcmp(module.version, commandVersion()) != 0)
    throw std::runtime_error(
        fmt::format("{}: is of version {}, this program of {}; install the same version of both",
                    file.string(), module.version, commandVersion()));
  return module;
}

}  // namespace ortung::app
