#include "Calibrate.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "Interrupt.hpp"
#include "Outputs.hpp"
#include "Progress.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/calibration/ImageFile.hpp"
#include "ortung/calibration/LineCalibration.hpp"
#include "ortung/sim/SimWorld.hpp"
#include "ortung/vision/FloorSight.hpp"
#include "ortung/vision/LineFinder.hpp"

namespace ortung::app {
namespace {

namespace fs = std::filesystem;

/// Returns the file of a picture with drawings; it is announced before any work begins.
fs::path drawnFile(const fs::path& folder, const fs::path& picture) {
  return folder / (picture.stem().string() + ".png");
}

void announceDrawings(Outputs& outputs, const fs::path& folder,
                      const std::vector<fs::path>& pictures) {
  for (const fs::path& picture : pictures) outputs.reads(picture);
  if (folder.empty()) return;
  fs::create_directories(folder);
  for (const fs::path& picture : pictures)
    outputs.writes("--draw", drawnFile(folder, picture), OutputKind::kPicture);
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

struct Look {
  Picture picture;
  LinePicture lines;
};

Look lookAt(const fs::path& file) {
  Look look{readPicture(file), {}};
  const ImageView view = look.picture.view();
  const ColourTable colours(findColours({&view, 1}));
  LineFinder finder({});
  const auto points = finder.find(view, colours);
  look.lines = {{points.begin(), points.end()}, floorTopOf(view, colours)};
  return look;
}

/// Draws the field's lines where the camera would see them.
void drawField(Picture& picture, const FieldLines& field, const CameraView& view,
               const Pose2& pose) {
  const auto dot = [&](double x, double y) {
    const Pose2 place = inverse(pose) * Pose2{x, y, 0.0};
    if (const auto pixel = view.pixelOf({place.x, place.y, 0.0})) picture.dot(*pixel, 0, 0, 0, 255);
  };
  constexpr double kStep = 0.02;  // distance between drawn points [m]
  for (const FieldLine& line : field.lines()) {
    if (line.shape == FieldLine::Shape::kStraight) {
      const double length = std::hypot(line.x1 - line.x0, line.y1 - line.y0);
      for (double d = 0.0; d <= length; d += kStep)
        dot(line.x0 + (line.x1 - line.x0) * d / length, line.y0 + (line.y1 - line.y0) * d / length);
      continue;
    }
    const double c = std::cos(line.angle);
    const double s = std::sin(line.angle);
    const double step = kStep / std::max(line.radiusX, line.radiusY);
    for (double t = line.from; t <= line.to; t += step) {
      const double x = line.radiusX * std::cos(t);
      const double y = line.radiusY * std::sin(t);
      dot(line.x + c * x - s * y, line.y + s * x + c * y);
    }
  }
}

struct Best {
  LineCalibration calibration;
  FieldLines field;
  std::string world;
};

Best calibrate(const CalibrateLinesArguments& arguments, const std::vector<Look>& looks) {
  std::vector<LinePicture> pictures;
  for (const Look& look : looks) pictures.push_back(look.lines);
  Progress progress("calibrating", arguments.progress);
  LineCalibrationGuess guess;
  guess.height = arguments.height;
  guess.heightShare = arguments.heightShare;
  std::optional<Best> best;
  for (std::size_t i = 0; i < arguments.worlds.size(); ++i) {
    const auto world = readWorld(arguments.worlds[i]);
    const FieldModel model = fieldModelOf(*world);
    const FieldLines lines(model.lines);
    const auto found = calibrateByLines(
        looks.front().picture.size, pictures, LinePoseSearch(lines), guess, [&](double share) {
          checkInterrupt();
          progress.update((static_cast<double>(i) + share) /
                          static_cast<double>(arguments.worlds.size()));
        });
    if (!found) throw std::runtime_error("no line was found in any of the pictures");
    if (!best || found->cost < best->calibration.cost)
      best = Best{*found, lines, arguments.worlds[i].string()};
  }
  return *best;
}

void report(const CalibrateLinesArguments& arguments, const std::vector<Look>& looks,
            const Best& best) {
  const LineCalibration& c = best.calibration;
  fmt::print("{:<44} {:>6} {:>9} {:>10} {:>8}   pose on the field\n", "picture", "points",
             "within 5m", "median [m]", "matched");
  for (std::size_t i = 0; i < looks.size(); ++i) {
    const LinePictureFit& fit = c.pictures[i];
    fmt::print("{:<44} {:>6} {:>9} {:>10} {:>7.0f}%   {:.2f} m, {:.2f} m, {:.0f} degrees\n",
               arguments.pictures[i].filename().string(), looks[i].lines.points.size(), fit.points,
               fit.points > 0 ? fmt::format("{:.3f}", fit.median) : "-", 100.0 * fit.matchedShare,
               fit.pose.x, fit.pose.y, degrees(fit.pose.theta));
  }
  if (arguments.worlds.size() > 1) fmt::print("fits best: {}\n", best.world);
  fmt::print("height {:.3f} m, tilt {:.2f} degrees, roll {:.2f} degrees\n\n", c.view.place().z,
             degrees(c.view.place().tilt), degrees(c.view.place().roll));
}

}  // namespace

int runCalibrateLines(const CalibrateLinesArguments& arguments) {
  Outputs outputs(arguments.force);
  for (const fs::path& world : arguments.worlds) outputs.reads(world);
  announceDrawings(outputs, arguments.draw, arguments.pictures);
  outputs.writes("--out", arguments.out, OutputKind::kSettings);
  std::vector<Look> looks;
  for (const fs::path& file : arguments.pictures) {
    looks.push_back(lookAt(file));
    if (!(looks.back().picture.size == looks.front().picture.size))
      throw std::runtime_error(
          fmt::format("{}: has another size than {}, so it is of another camera", file.string(),
                      arguments.pictures.front().string()));
  }
  const Best best = calibrate(arguments, looks);
  report(arguments, looks, best);
  printTable(
      outputs, arguments.out,
      fmt::format("# pose = {{ z_m = {:.4f} }} of the [[sensor]] itself\n[sensor.camera]\n{}",
                  best.calibration.view.place().z, toToml(best.calibration.view)));
  for (std::size_t i = 0; i < looks.size() && !arguments.draw.empty(); ++i) {
    Picture& picture = looks[i].picture;
    drawField(picture, best.field, best.calibration.view, best.calibration.pictures[i].pose);
    for (const LinePoint& point : looks[i].lines.points) picture.dot(point.pixel, 1, 255, 0, 0);
    writePng(outputs, drawnFile(arguments.draw, arguments.pictures[i]), picture);
  }
  return 0;
}

int runCalibrateColours(const CalibrateColoursArguments& arguments) {
  Outputs outputs(arguments.force);
  announceDrawings(outputs, arguments.draw, arguments.pictures);
  outputs.writes("--out", arguments.out, OutputKind::kSettings);
  std::vector<Picture> pictures;
  std::vector<ImageView> views;
  for (const fs::path& file : arguments.pictures) pictures.push_back(readPicture(file));
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
