#include "OutputFile.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string>

namespace ortung::app {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& what) {
  throw std::runtime_error(file.string() + ": " + what);
}

std::filesystem::path folderOf(const std::filesystem::path& file) {
  return file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
}

}  // namespace

void checkOutput(const std::filesystem::path& file) {
  std::error_code error;
  if (std::filesystem::is_directory(file, error)) refuse(file, "is a folder, expected a file");
  const std::filesystem::path folder = folderOf(file);
  if (!std::filesystem::is_directory(folder, error)) {
    refuse(file, "can't be written: there is no folder " + folder.string());
  }
  if (access(folder.c_str(), W_OK) != 0) {
    refuse(file, std::string("can't be written: ") + std::strerror(errno));
  }
}

}  // namespace ortung::app
