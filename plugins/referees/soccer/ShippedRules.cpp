#include <dlfcn.h>

#include <cstdlib>

#include "Rules.hpp"

namespace ortung::soccer {
namespace {

/// Where this library lies, or nothing.
std::filesystem::path ownFolder() {
  static const char kHere = 0;
  Dl_info info{};
  if (::dladdr(&kHere, &info) == 0 || info.dli_fname == nullptr) return {};
  std::error_code error;
  const auto file = std::filesystem::canonical(info.dli_fname, error);
  return error ? std::filesystem::path{} : file.parent_path();
}

std::vector<std::filesystem::path> foldersOfMaps() {
  std::vector<std::filesystem::path> folders;
  if (const char* maps = std::getenv("ORTUNG_MAPS"); maps != nullptr && *maps != '\0')
    folders.emplace_back(maps);
  const auto own = ownFolder();
  if (own.empty()) return folders;
  folders.push_back((own / ORTUNG_INSTALLED_MAPS).lexically_normal());
  folders.push_back((own / "../../../share/ortung/maps").lexically_normal());  // of a build
  return folders;
}

}  // namespace

std::filesystem::path shippedRules(const std::string& name) {
  std::string looked;
  if (name.empty() || name.find_first_of("/\\") != name.npos)
    throw ConfigError("'" + name + "' is no name of rules that ship; those of files end in .toml");
  for (const auto& folder : foldersOfMaps()) {
    const auto file = folder / "rules" / (name + ".toml");
    std::error_code ignored;
    if (std::filesystem::is_regular_file(file, ignored)) return file;
    looked += (looked.empty() ? "" : ", ") + file.string();
  }
  throw ConfigError("rules '" + name + "' are in none of: " + looked +
                    "; ORTUNG_MAPS may name the folder of the maps");
}

}  // namespace ortung::soccer
