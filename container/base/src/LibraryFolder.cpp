#include "ortung/base/LibraryFolder.hpp"

#include <dlfcn.h>

#include <system_error>

namespace ortung {
namespace {

const char kHere = 0;  ///< lies in the library, so its address tells which file that is

std::filesystem::path folderOfThisFile() {
  Dl_info info{};
  if (::dladdr(&kHere, &info) == 0 || info.dli_fname == nullptr) return {};
  std::error_code none;
  return std::filesystem::canonical(info.dli_fname, none).parent_path();
}

}  // namespace

#ifndef ORTUNG_LIB_FROM_BIN

std::filesystem::path libraryFolder() { return folderOfThisFile(); }

#else

std::filesystem::path libraryFolder() {
  const std::filesystem::path here = folderOfThisFile();
  const bool isModule = here.filename() == "plugins" || here.filename() == "commands";
  if (isModule && here.parent_path().filename() == "ortung")
    return here.parent_path().parent_path();
  std::error_code none;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", none).parent_path();
  if (program.empty()) return {};
  const auto installed = (program / ORTUNG_LIB_FROM_BIN).lexically_normal();
  const auto built = program.parent_path() / "lib";
  return std::filesystem::is_directory(installed / "ortung", none) ? installed : built;
}

#endif

}  // namespace ortung
