/// ortung-mrpt-reader: prints MRPT's binary files as text, for programs that neither link MRPT nor
/// trust its readers, which believe every length that a file states.
///   ortung-mrpt-reader rawlog FILE    "# ortung-mrpt-reader 1", the number of the format, then
///                                     readings as lines of a record (see RawlogPrinter.hpp)
///   ortung-mrpt-reader gridmap FILE   "ortung-gridmap WIDTH HEIGHT RESOLUTION ORIGIN_X ORIGIN_Y",
///                                     then a byte a cell: 255 free, 0 occupied; bottom row first

#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/serialization/CArchive.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>

#include "RawlogPrinter.hpp"

namespace ortung {
namespace {

constexpr rlim_t kMaxMemory = 4ull << 30;  // bytes of address space; MRPT's libraries take 1.2 GB
constexpr rlim_t kMaxSeconds = 300;        // seconds of the processor
constexpr std::size_t kMaxCells = 1u << 26;

void limitOurselves() {
  const auto limit = [](auto what, rlim_t most) {
    const rlimit both{most, most};
    if (setrlimit(what, &both) != 0) throw std::runtime_error("limits cannot be set");
  };
// Sanitizers reserve terabytes of addresses.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  limit(RLIMIT_AS, kMaxMemory);
#endif
  limit(RLIMIT_CPU, kMaxSeconds);
  limit(RLIMIT_CORE, 0);
}

/// MRPT writes to the standard output, too, so this program's output gets a descriptor of its own.
std::FILE* ownOutput() {
  const int copy = dup(STDOUT_FILENO);
  std::FILE* const out = copy < 0 ? nullptr : fdopen(copy, "wb");
  if (!out || dup2(STDERR_FILENO, STDOUT_FILENO) < 0) throw std::runtime_error("no output");
  return out;
}

void printRawlog(mrpt::serialization::CArchive& archive, std::FILE* out) {
  RawlogPrinter printer(out);
  std::fputs("# ortung-mrpt-reader 1\n", out);
  std::size_t objects = 0;
  try {
    for (;; ++objects) {
      const auto object = archive.ReadObject();
      if (!object) throw std::runtime_error("found an empty object");
      printer.print(*object);
    }
  } catch (const mrpt::serialization::CExceptionEOF&) {
    if (objects == 0) throw std::runtime_error("found no object, expected a rawlog");
  }
  printer.finish();
}

void printGrid(mrpt::serialization::CArchive& archive, std::FILE* out) {
  mrpt::maps::COccupancyGridMap2D map;
  archive >> map;  // throws for grids without an origin or cell size
  const std::size_t width = map.getSizeX();
  const std::size_t height = map.getSizeY();
  if (width == 0 || height == 0 || width > kMaxCells / height) {
    throw std::runtime_error("found a grid of " + std::to_string(width) + " x " +
                             std::to_string(height) + " cells, expected at most 2^26");
  }
  const double origin[2] = {map.getXMin(), map.getYMin()};
  const double resolution = map.getResolution();
  std::fprintf(out, "ortung-gridmap %zu %zu %.9g %.9g %.9g\n", width, height, resolution, origin[0],
               origin[1]);
  std::string row(width, '\0');
  for (std::size_t y = 0; y < height; ++y) {
    for (std::size_t x = 0; x < width; ++x) {
      const float free = map.getCell(static_cast<int>(x), static_cast<int>(y));
      row[x] = static_cast<char>(std::lround(255.0F * std::clamp(free, 0.0F, 1.0F)));
    }
    if (std::fwrite(row.data(), 1, width, out) != width)
      throw std::runtime_error("the output cannot be written");
  }
  if (std::fflush(out) != 0) throw std::runtime_error("the output cannot be written");
}

/// Returns the one line that matters of MRPT's message, which is a stack trace.
std::string oneLine(const std::string& text) {
  const std::string mark = "Message:";
  const std::size_t at = text.find(mark);
  const std::size_t begin =
      at == std::string::npos ? 0 : text.find_first_not_of(" \r\n", at + mark.size());
  if (begin == std::string::npos) return "unknown error";
  return text.substr(begin, text.find_first_of("\r\n", begin) - begin);
}

int run(const std::string& what, const std::string& file, std::FILE* out) {
  try {
    mrpt::io::CFileGZInputStream stream;
    if (!stream.open(file)) throw std::runtime_error("cannot be opened");
    auto archive = mrpt::serialization::archiveFrom(stream);
    what == "rawlog" ? printRawlog(archive, out) : printGrid(archive, out);
    return 0;
  } catch (const std::exception& error) {
    const std::string text = oneLine(error.what());
    std::fprintf(stderr, "%s: %s\n", file.c_str(), text.c_str());
    std::fprintf(out, "# error %s\n", text.c_str());
    std::fflush(out);
    return 1;
  }
}

}  // namespace
}  // namespace ortung

int main(int count, char** arguments) {
  const std::string what = count == 3 ? arguments[1] : "";
  if (what != "rawlog" && what != "gridmap") {
    std::fputs("usage: ortung-mrpt-reader rawlog|gridmap FILE\n", stderr);
    return 2;
  }
  try {
    ortung::limitOurselves();
    return ortung::run(what, arguments[2], ortung::ownOutput());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "ortung-mrpt-reader: %s\n", error.what());
    return 1;
  }
}
