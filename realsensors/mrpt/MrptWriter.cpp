/// ortung-mrpt-writer: makes MRPT's binary files from text, for programs that do not link MRPT.
///   ortung-mrpt-writer rawlog IN OUT    IN: lines of a record (see RawlogMaker.hpp)
///   ortung-mrpt-writer gridmap IN OUT   IN: as `ortung-mrpt-reader gridmap` prints it
/// Prints how many objects it has written, or "# error" and why not.

#include <mrpt/io/CFileGZOutputStream.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/serialization/CArchive.h>

#include <cstdio>
#include <fstream>
#include <stdexcept>
#include <string>

#include "RawlogMaker.hpp"

namespace ortung {
namespace {

constexpr std::size_t kMaxCells = 1U << 26;

std::size_t writeRawlog(std::istream& in, mrpt::serialization::CArchive& archive) {
  RawlogMaker maker;
  std::size_t objects = 0;
  for (std::string line; std::getline(in, line);) {
    const auto observation = maker.observationOf(line);
    if (!observation) continue;
    archive << *observation;
    ++objects;
  }
  return objects;
}

std::size_t writeGrid(std::istream& in, mrpt::serialization::CArchive& archive) {
  std::string magic;
  std::size_t width = 0;
  std::size_t height = 0;
  double resolution = 0.0;
  double x = 0.0;
  double y = 0.0;
  in >> magic >> width >> height >> resolution >> x >> y;
  in.get();
  if (!in || magic != "ortung-gridmap" || width == 0 || height == 0 || width > kMaxCells / height)
    throw std::runtime_error("found no grid");
  mrpt::maps::COccupancyGridMap2D map;
  const auto far = [&](double from, std::size_t cells) {
    return static_cast<float>(from + static_cast<double>(cells) * resolution);
  };
  map.setSize(static_cast<float>(x), far(x, width), static_cast<float>(y), far(y, height),
              static_cast<float>(resolution));
  if (map.getSizeX() != width || map.getSizeY() != height)
    throw std::runtime_error("the grid's origin is not a multiple of its resolution");
  std::string row(width, 0);
  for (std::size_t iy = 0; iy < height; ++iy) {
    if (!in.read(row.data(), static_cast<std::streamsize>(width)))
      throw std::runtime_error("the grid is torn");
    for (std::size_t ix = 0; ix < width; ++ix)
      map.setCell(static_cast<int>(ix), static_cast<int>(iy),
                  static_cast<float>(static_cast<unsigned char>(row[ix])) / 255.0F);
  }
  archive << map;
  return 1;
}

int run(const std::string& what, const std::string& from, const std::string& to) try {
  std::ifstream in(from, std::ios::binary);
  if (!in) throw std::runtime_error(from + " cannot be opened");
  mrpt::io::CFileGZOutputStream out;
  if (!out.open(to)) throw std::runtime_error(to + " cannot be opened");
  auto archive = mrpt::serialization::archiveFrom(out);
  const std::size_t objects = what == "rawlog" ? writeRawlog(in, archive) : writeGrid(in, archive);
  std::printf("%zu\n", objects);
  return 0;
} catch (const std::exception& error) {
  std::string text = error.what();
  for (char& c : text) c = c == '\n' ? ' ' : c;
  std::printf("# error %s\n", text.c_str());
  return 1;
}

}  // namespace
}  // namespace ortung

int main(int count, char** arguments) {
  const std::string what = count == 4 ? arguments[1] : "";
  if (what != "rawlog" && what != "gridmap") {
    std::fputs("usage: ortung-mrpt-writer rawlog|gridmap IN OUT\n", stderr);
    return 2;
  }
  return ortung::run(what, arguments[2], arguments[3]);
}
