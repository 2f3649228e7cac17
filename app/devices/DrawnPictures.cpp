#include "DrawnPictures.hpp"

#include <fmt/format.h>

#include <span>

namespace ortung::app {

namespace fs = std::filesystem;

fs::path drawnFile(const fs::path& folder, const fs::path& picture) {
  return folder / (picture.stem().string() + ".png");
}

void announceDrawings(Outputs& outputs, const fs::path& folder,
                      const std::vector<fs::path>& pictures, const std::vector<fs::path>& names) {
  for (const fs::path& picture : pictures) outputs.reads(picture);
  if (folder.empty()) return;
  fs::create_directories(folder);
  for (const fs::path& name : names.empty() ? pictures : names)
    outputs.writes("--draw", drawnFile(folder, name), OutputKind::kPicture);
}

void writePng(const Outputs& outputs, const fs::path& file, const Picture& picture) {
  const std::vector<std::uint8_t> png = toPng(picture.view());
  outputs.write(file, std::as_bytes(std::span(png)));
}

void printTable(const Outputs& outputs, const fs::path& out, const std::string& table) {
  if (out.empty())
    fmt::print("{}", table);
  else
    outputs.write(out, table);
}

}  // namespace ortung::app
