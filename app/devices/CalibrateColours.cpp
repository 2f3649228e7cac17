#include "Calibrate.hpp"
#include "DrawnPictures.hpp"
#include "Outputs.hpp"
#include "ortung/vision/LineFinder.hpp"

namespace ortung::app {

int runCalibrateColours(const CalibrateColoursArguments& arguments) {
  Outputs outputs(arguments.force);
  announceDrawings(outputs, arguments.draw, arguments.pictures);
  outputs.writes("--out", arguments.out, OutputKind::kSettings);
  std::vector<Picture> pictures;
  std::vector<ImageView> views;
  for (const std::filesystem::path& file : arguments.pictures)
    pictures.push_back(readPicture(file));
  for (const Picture& picture : pictures) views.push_back(picture.view());
  const Colours colours = findColours(views);
  printTable(outputs, arguments.out, "[sensor.colours]\n" + toToml(colours));
  const ColourTable table(colours);
  LineFinder finder({});
  for (std::size_t i = 0; i < pictures.size() && !arguments.draw.empty(); ++i) {
    Picture drawn = pictures[i];
    for (std::size_t at = 0; at + 2 < drawn.pixels.size(); at += 3) {
      std::uint8_t* p = drawn.pixels.data() + at;
      if (table.isBall(p)) {
        p[0] = 255, p[1] = 128, p[2] = 0;
      } else if (table.isFloor(p)) {
        p[0] = p[2] = 0, p[1] = 160;
      }
    }
    for (const LinePoint& point : finder.find(pictures[i].view(), table))
      drawn.dot(point.pixel, 1, 255, 0, 0);
    writePng(outputs, drawnFile(arguments.draw, arguments.pictures[i]), drawn);
  }
  return 0;
}

}  // namespace ortung::app
