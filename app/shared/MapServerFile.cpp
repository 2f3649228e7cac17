#include "MapServerFile.hpp"

#include <fmt/format.h>

#include <string>

#include "Outputs.hpp"

namespace ortung::app {
namespace {

/// A grey picture (PGM) with the top row first.
std::string pictureOf(const WorldGrid& grid) {
  std::string text = fmt::format("P5\n{} {}\n255\n", grid.columns, grid.rows);
  for (std::size_t row = grid.rows; row-- > 0;)
    text.append(grid.cells, row * grid.columns, grid.columns);
  return text;
}

}  // namespace

void writeMapServer(const WorldGrid& grid, const std::filesystem::path& yaml) {
  std::filesystem::path picture = yaml;
  picture.replace_extension(".pgm");
  writeFile(picture, pictureOf(grid));
  writeFile(yaml, fmt::format("image: {}\nresolution: {}\norigin: [{}, {}, 0]\nnegate: 0\n"
                              "occupied_thresh: 0.65\nfree_thresh: 0.196\n",
                              picture.filename().string(), grid.cell, grid.originX, grid.originY));
}

}  // namespace ortung::app
