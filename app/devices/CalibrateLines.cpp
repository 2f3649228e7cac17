#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <stdexcept>

#include "Calibrate.hpp"
#include "Console.hpp"
#include "DrawnPictures.hpp"
#include "Interrupt.hpp"
#include "LineLook.hpp"
#include "LineReport.hpp"
#include "Outputs.hpp"
#include "Progress.hpp"
#include "ortung/base/Parameters.hpp"
#include "ortung/calibration/LineCalibration.hpp"
#include "ortung/robot/TomlFile.hpp"
#include "ortung/sim/SimWorld.hpp"

namespace ortung::app {
namespace {

namespace fs = std::filesystem;

/// Reads the focal length of a camera that was calibrated before.
double focalOf(const fs::path& file, const ImageSize& size) {
  const Parameters camera = readToml(file).table("sensor").table("camera");
  const std::string model = camera.textOr("model", "perspective");
  if (model != "fisheye")
    throw std::runtime_error(
        fmt::format("{}: is a camera of the model {}, expected a fisheye, as "
                    "`ortung calibrate lines --out` writes it",
                    file.string(), printable(model)));
  const std::vector<double> its = camera.numbers("size_px", 2);
  if (its[0] != size.width || its[1] != size.height)
    throw std::runtime_error(
        fmt::format("{}: is a camera of {:.0f} x {:.0f} pixels, the pictures have {} x {}",
                    file.string(), its[0], its[1], size.width, size.height));
  const std::vector<double> focal = camera.numbers("focal_px", 2);
  return 0.5 * (focal[0] + focal[1]);
}

struct Best {
  LineCalibration calibration;
  FieldLines field;
  std::string world;
};

LineCalibrationGuess guessOf(const CalibrateLinesArguments& arguments, const ImageSize& size) {
  LineCalibrationGuess guess;
  guess.height = arguments.height;
  guess.heightShare = arguments.heightShare;
  for (const fs::path& file : arguments.like) guess.kind.push_back(focalOf(file, size));
  return guess;
}

/// Calibrates with each world: the one that fits best, which knows the others as its rivals.
Best calibrate(const CalibrateLinesArguments& arguments, const std::vector<Look>& looks) {
  std::vector<LinePicture> pictures;
  for (const Look& look : looks) pictures.push_back(look.lines);
  Progress progress("calibrating", arguments.progress);
  const LineCalibrationGuess guess = guessOf(arguments, looks.front().picture.size);
  std::vector<Best> all;
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
    if (!found)
      throw std::runtime_error(
          "the camera is not determined: take pictures that show lines within 5 m (no line was "
          "found "
          "in any of these)");
    all.push_back({*found, lines, arguments.worlds[i].string()});
  }
  Best& best = *std::min_element(all.begin(), all.end(), [](const Best& a, const Best& b) {
    return a.calibration.cost < b.calibration.cost;
  });
  for (const Best& other : all)
    if (&other != &best) considerRival(best.calibration, other.calibration);
  best.calibration.verdict = judgeCalibration(best.calibration, guess);
  return best;
}

/// The file with the verdict, beside the one with the calibration.
fs::path verdictFile(const fs::path& out) {
  return out.empty() ? out : fs::path(out).replace_extension(".verdict.json");
}

void drawAll(const CalibrateLinesArguments& arguments, const Outputs& outputs,
             std::vector<Look>& looks, const Best& best) {
  for (std::size_t i = 0; i < looks.size() && !arguments.draw.empty(); ++i) {
    draw(looks[i], best.field, best.calibration.view, best.calibration.pictures[i].pose);
    writePng(outputs, drawnFile(arguments.draw, arguments.pictures[i]), looks[i].picture);
  }
}

}  // namespace

int runCalibrateLines(const CalibrateLinesArguments& arguments) {
  Outputs outputs(arguments.force);
  for (const fs::path& world : arguments.worlds) outputs.reads(world);
  for (const fs::path& camera : arguments.like) outputs.reads(camera);
  announceDrawings(outputs, arguments.draw, arguments.pictures);
  outputs.writes("--out", arguments.out, OutputKind::kSettings);
  outputs.writes("--out", verdictFile(arguments.out), OutputKind::kSettings);
  std::vector<Look> looks = lookAtAll(arguments.pictures);
  const Best best = calibrate(arguments, looks);
  const LineCalibration& calibration = best.calibration;
  LineResult result{calibration, best.world, arguments.pictures, {}};
  for (const Look& look : looks) result.points.push_back(look.lines.points.size());
  fmt::print("{}", toText(result, arguments.worlds.size() > 1));
  drawAll(arguments, outputs, looks, best);
  if (!arguments.out.empty()) outputs.write(verdictFile(arguments.out), toJson(result));
  if (!calibration.verdict.isDetermined()) {
    fail("the camera is " + calibration.verdict.sentence() +
         (arguments.out.empty() ? "" : " (no calibration is written)"));
    return 1;
  }
  printTable(
      outputs, arguments.out,
      fmt::format("# pose = {{ z_m = {:.4f} }} of the [[sensor]] itself\n[sensor.camera]\n{}",
                  calibration.view.place().z, toToml(calibration.view)));
  return 0;
}

}  // namespace ortung::app
