#include "ProgramFiles.hpp"

#include <link.h>

#include <filesystem>
#include <set>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "ContentDigest.hpp"

namespace ortung::app {
namespace {

namespace fs = std::filesystem;

bool isOurs(const std::string& name) {
  const std::string_view text = name;
  return text.starts_with("libortung_") || text.starts_with("ortung_command_");
}

/// Returns the program's own files among those that the process has loaded.
std::vector<fs::path> loadedFiles() {
  std::vector<fs::path> files;
  const auto take = [](dl_phdr_info* info, std::size_t, void* out) {
    const fs::path file = info->dlpi_name;
    if (isOurs(file.filename().string())) static_cast<std::vector<fs::path>*>(out)->push_back(file);
    return 0;
  };
  ::dl_iterate_phdr(take, &files);
  return files;
}

}  // namespace

std::map<std::string, std::string> digestsOfProgram() {
  std::map<std::string, std::string> digests;
  for (const fs::path& file : loadedFiles()) digests[file.filename().string()] = digestOfFile(file);
  return digests;
}

std::string digestOfProgramFile(const std::string& name) {
  if (!isOurs(name) || name.find('/') != name.npos) return "missing";
  std::set<fs::path> folders;
  for (const fs::path& file : loadedFiles()) folders.insert(file.parent_path());
  for (const fs::path& folder : folders) {
    std::error_code error;
    if (fs::exists(folder / name, error)) return digestOfFile(folder / name);
  }
  return "missing";
}

}  // namespace ortung::app
