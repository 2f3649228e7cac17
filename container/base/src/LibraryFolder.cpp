#include "LibraryFolder.hpp"

#include <dlfcn.h>

#include <system_error>

namespace ortung {
namespace {

const char kHere = 0;  ///< lies in the library, so its address tells which file that is

}  // namespace

std::filesystem::path libraryFolder() {
  Dl_info info{};
  if (::dladdr(&kHere, &info) == 0 || info.dli_fname == nullptr) return {};
  std::error_code none;
  return std::filesystem::canonical(info.dli_fname, none).parent_path();
}

}  // namespace ortung
