#include <cmath>
#include <sstream>
#include <vector>

#include "GridMap.hpp"
#include "ortung/base/HelperProgram.hpp"

namespace ortung {
namespace {

constexpr const char* kReader = "ortung-mrpt-reader";
constexpr std::size_t kMaxHeader = 256;
constexpr int kUnknownFrom = 100;  ///< least p(free), of 255, of an unknown cell
constexpr int kUnknownTo = 155;    ///< greatest p(free), of 255, of an unknown cell

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
  std::string output;
  try {
    output = runHelper(findHelper(kReader, file.string()),
                       {"gridmap", std::filesystem::absolute(file).string()}, file.string(),
                       kMaxGridCells + kMaxHeader);
  } catch (const std::runtime_error& failure) {
    throw MapError(failure.what());
  }
  const std::size_t end = output.substr(0, kMaxHeader).find('\n');
  GridMap map = readHeader(file, output.substr(0, std::min(end, kMaxHeader)));
  const std::size_t n = static_cast<std::size_t>(map.columns) * static_cast<std::size_t>(map.rows);
  if (end == std::string::npos || output.size() != end + 1 + n)
    throw MapError(file.string() + ": " + kReader + " gave " + std::to_string(output.size()) +
                   " bytes, expected a line and " + std::to_string(n) + " cells");
  map.cells.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const int free = static_cast<unsigned char>(output[end + 1 + i]);
    map.cells[i] = free < kUnknownFrom ? GridCell::kOccupied
                   : free > kUnknownTo ? GridCell::kFree
                                       : GridCell::kUnknown;
  }
  return map;
}

}  // namespace ortung
