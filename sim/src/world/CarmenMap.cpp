#include <bit>
#include <cmath>
#include <cstring>
#include <optional>
#include <sstream>

#include "BoundedFile.hpp"
#include "GridMap.hpp"

static_assert(std::endian::native == std::endian::little, "CARMEN maps are little-endian");

namespace ortung {
namespace {

constexpr std::size_t kMaxBytes = 4 * kMaxGridCells + (std::size_t{16} << 20);
constexpr std::string_view kLabel = "CARMENMAPFILEv020";
constexpr int kGridChunk = 1;
constexpr int kNamedFlag = 128;
constexpr std::size_t kDescriptionBytes = 10;
/// Cells above are occupied; between the two they are unknown.
constexpr float kOccupiedAbove = 0.6f;
constexpr float kFreeBelow = 0.4f;

/// Reads consecutive numbers, never beyond the end.
class Bytes {
 public:
  Bytes(const std::filesystem::path& file, std::string_view bytes) : file_(file), bytes_(bytes) {}

  [[noreturn]] void refuse(const std::string& what) const {
    throw MapError(file_.string() + ": at byte " + std::to_string(at_) + ": " + what);
  }
  bool atEnd() const { return at_ >= bytes_.size(); }
  bool begins(std::string_view text) const { return bytes_.substr(at_).starts_with(text); }
  std::string_view take(std::size_t n) {
    if (n > bytes_.size() - at_)
      refuse("the file ends " + std::to_string(n - (bytes_.size() - at_)) + " bytes early");
    at_ += n;
    return bytes_.substr(at_ - n, n);
  }
  void skipPast(char end, const char* what) {
    const std::size_t found = bytes_.find(end, at_);
    if (found == std::string_view::npos) refuse(std::string("the file ends within ") + what);
    at_ = found + 1;
  }
  template <class T>
  T number() {
    T value;
    std::memcpy(&value, take(sizeof(T)).data(), sizeof(T));
    return value;
  }

 private:
  std::filesystem::path file_;
  std::string_view bytes_;
  std::size_t at_ = 0;
};

void skipComments(Bytes& bytes) {
  while (bytes.begins("#")) bytes.skipPast('\n', "a comment");
  if (!bytes.begins(kLabel))
    bytes.refuse("expected \"" + std::string(kLabel) + "\" after the comments of a CARMEN map");
  bytes.take(kLabel.size());
}

/// Finds the data of the grid chunk. A chunk is a byte of kind, a length and that many bytes.
Bytes findGridChunk(const std::filesystem::path& file, Bytes& bytes) {
  while (!bytes.atEnd()) {
    const int kind = bytes.number<std::uint8_t>();
    const auto length = bytes.number<std::int32_t>();
    if (length < 0) bytes.refuse("a chunk of " + std::to_string(length) + " bytes");
    Bytes chunk(file, bytes.take(static_cast<std::size_t>(length)));
    if ((kind & ~kNamedFlag) != kGridChunk) continue;
    chunk.take(kDescriptionBytes);
    if ((kind & kNamedFlag) != 0) chunk.skipPast('\0', "the name of the grid");
    return chunk;
  }
  bytes.refuse("the CARMEN map has no grid (GRIDMAP chunk)");
}

GridCell toCell(const Bytes& chunk, float occupied) {
  if (!(occupied >= -1.0f && occupied <= 1.0f)) {
    std::ostringstream message;
    message << "a cell is " << occupied << ", expected -1 (unknown) or 0 (free) to 1 (occupied)";
    chunk.refuse(message.str());
  }
  if (occupied > kOccupiedAbove) return GridCell::kOccupied;
  return occupied >= 0.0f && occupied < kFreeBelow ? GridCell::kFree : GridCell::kUnknown;
}

}  // namespace

// Follows the format of CARMEN's map library: columns, rows, resolution, then the columns from left
// to right, each from bottom to top. Such maps have no origin: the lower left corner is (0, 0).
GridMap readCarmenMap(const std::filesystem::path& file) {
  const std::string all = readUnpacked(file, kMaxBytes);
  Bytes bytes(file, all);
  skipComments(bytes);
  Bytes chunk = findGridChunk(file, bytes);
  GridMap map;
  map.columns = chunk.number<std::int32_t>();
  map.rows = chunk.number<std::int32_t>();
  map.cell = static_cast<double>(chunk.number<float>());
  checkGrid(file, map.columns, map.rows, map.cell, 0.0, 0.0);
  const std::size_t n = static_cast<std::size_t>(map.columns) * static_cast<std::size_t>(map.rows);
  Bytes cells(file, chunk.take(n * sizeof(float)));  // checked before memory is taken
  map.cells.resize(n);
  for (int column = 0; column < map.columns; ++column)
    for (int row = 0; row < map.rows; ++row)
      map.cells[map.index(column, row)] = toCell(cells, cells.number<float>());
  return map;
}

}  // namespace ortung
