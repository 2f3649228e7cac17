#include <cmath>
#include <cstdlib>
#include <sstream>
#include <vector>

#include "ChildProcess.hpp"
#include "GridMap.hpp"

namespace ortung {
namespace {

constexpr const char* kReader = "ortung-mrpt-reader";
constexpr std::size_t kMaxHeader = 256;
constexpr std::chrono::seconds kLimit{120};
constexpr int kUnknownFrom = 100;  ///< of 255: p(free) between these says nothing
constexpr int kUnknownTo = 155;

/// Beside the running program or where it was installed, unless the environment says where.
std::vector<std::filesystem::path> readerFolders() {
  const char* folder = std::getenv("ORTUNG_LIBEXEC");
  if (folder != nullptr && *folder != '\0') return {folder};
  std::error_code error;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
  if (error) return {};
  return {program, program.parent_path() / "libexec" / "ortung"};
}

std::filesystem::path findReader(const std::filesystem::path& file) {
  std::string looked;
  for (const auto& folder : readerFolders()) {
    std::error_code ignored;
    const auto program = folder / kReader;
    if (std::filesystem::is_regular_file(program, ignored)) return program;
    looked += (looked.empty() ? "" : ", ") + folder.string();
  }
  throw MapError(file.string() + ": MRPT's grid maps need the program " + kReader +
                 ", which is not in " + looked +
                 "; build with ORTUNG_MRPT=ON or name its folder in ORTUNG_LIBEXEC");
}

/// Reads "ortung-gridmap WIDTH HEIGHT RESOLUTION ORIGIN_X ORIGIN_Y".
GridMap readHeader(const std::filesystem::path& file, const std::string& line) {
  std::istringstream words(line);
  words.imbue(std::locale::classic());
  std::string magic;
  GridMap map;
  words >> magic >> map.columns >> map.rows >> map.cell >> map.originX >> map.originY;
  if (!words || magic != "ortung-gridmap")
    throw MapError(file.string() + ": " + kReader + " answered \"" + line.substr(0, 80) +
                   "\", expected \"ortung-gridmap\" and five numbers");
  checkGrid(file, map.columns, map.rows, map.cell, map.originX, map.originY);
  return map;
}

}  // namespace

// MRPT's libraries trust the lengths in a file, so a program of its own reads it, within limits.
GridMap readMrptGridMap(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error))
    throw MapError(file.string() + ": no such file");
  const auto reader = findReader(file);
  ChildResult child;
  try {
    child = runChild(reader, {"gridmap", std::filesystem::absolute(file).string()},
                     kMaxGridCells + kMaxHeader, kLimit);
  } catch (const std::system_error& failure) {
    throw MapError(file.string() + ": " + failure.what());
  }
  if (!child.failure.empty())
    throw MapError(file.string() + ": " + kReader + " " + child.failure +
                   (child.errors.empty() ? "" : ": " + child.errors));
  const std::size_t end = child.output.substr(0, kMaxHeader).find('\n');
  GridMap map = readHeader(file, child.output.substr(0, std::min(end, kMaxHeader)));
  const std::size_t n = static_cast<std::size_t>(map.columns) * static_cast<std::size_t>(map.rows);
  if (end == std::string::npos || child.output.size() != end + 1 + n)
    throw MapError(file.string() + ": " + kReader + " gave " + std::to_string(child.output.size()) +
                   " bytes, expected a line and " + std::to_string(n) + " cells");
  map.cells.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const int free = static_cast<unsigned char>(child.output[end + 1 + i]);
    map.cells[i] = free < kUnknownFrom ? GridCell::occupied
                   : free > kUnknownTo ? GridCell::free
                                       : GridCell::unknown;
  }
  return map;
}

}  // namespace ortung
