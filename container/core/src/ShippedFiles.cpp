#include "ortung/core/ShippedFiles.hpp"

#include <cstdlib>
#include <vector>

#include "ortung/base/LibraryFolder.hpp"

namespace ortung {
namespace {

std::vector<std::filesystem::path> mapFolders() {
  std::vector<std::filesystem::path> folders;
  if (const char* variable = std::getenv("ORTUNG_MAPS_PATH")) folders.emplace_back(variable);
  const std::filesystem::path library = libraryFolder();
  if (library.empty()) return folders;
  folders.push_back((library / ORTUNG_MAPS_FROM_LIB).lexically_normal());
  folders.push_back(library.parent_path() / "share/ortung/maps");  // the folder of the build
  return folders;
}

}  // namespace

std::filesystem::path shippedFile(const std::filesystem::path& kind,
                                  const std::filesystem::path& file) {
  std::error_code error;
  if (file.empty() || file.is_absolute() || std::filesystem::exists(file, error)) return file;
  for (const std::filesystem::path& folder : mapFolders())
    if (std::filesystem::exists(folder / kind / file, error)) return folder / kind / file;
  return file;
}

}  // namespace ortung
