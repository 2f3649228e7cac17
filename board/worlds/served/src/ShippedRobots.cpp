#include "ShippedRobots.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "ortung/core/ShippedFiles.hpp"

namespace ortung {
namespace {

namespace fs = std::filesystem;

/// The first sentence of the comment at the beginning of a file.
std::string about(const fs::path& file) {
  std::ifstream in(file);
  std::string text;
  for (std::string line; std::getline(in, line) && line.starts_with("# ");) {
    text += line.substr(1);
    if (const std::size_t end = text.find(". "); end != text.npos) return text.substr(0, end + 1);
    if (text.ends_with('.')) return text;
  }
  return text;
}

}  // namespace

std::vector<std::string> shippedRobots() {
  std::vector<std::string> lines;
  std::error_code error;
  const fs::path folder = shippedFile(".", "robots/pioneer.toml").parent_path();
  for (fs::directory_iterator file(folder, error), end; !error && file != end;
       file.increment(error)) {
    const fs::path& path = file->path();
    if (path.extension() == ".toml") lines.push_back("robot " + path.stem().string() + about(path));
  }
  std::sort(lines.begin(), lines.end());
  return lines;
}

}  // namespace ortung
