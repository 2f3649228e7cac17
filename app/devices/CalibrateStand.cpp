#include <fmt/format.h>

#include <stdexcept>

#include "Calibrate.hpp"
#include "Console.hpp"
#include "DrawnPictures.hpp"
#include "LineLook.hpp"
#include "LineReport.hpp"
#include "Outputs.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/base/Parameters.hpp"
#include "ortung/calibration/StandCalibration.hpp"
#include "ortung/robot/TomlFile.hpp"
#include "ortung/sim/SimWorld.hpp"

namespace ortung::app {
namespace {

namespace fs = std::filesystem;

/// One table [[stand]].
struct StandRow {
  std::string name;  ///< the picture as the file has it
  fs::path picture;
  double tilt;  ///< [rad]
  std::optional<LinePlace> place;
};

std::vector<StandRow> readStands(const fs::path& file) {
  constexpr Range kTilt{-90.0, 90.0};
  constexpr Range kPlace{-1000.0, 1000.0};  // [m]
  constexpr std::size_t kMost = 1000;
  const Parameters toml = readToml(file);
  std::vector<StandRow> rows;
  for (const Parameters& one : toml.tables("stand")) {
    StandRow row{one.text("picture"), {}, radians(one.number("tilt_deg", kTilt)), {}};
    row.picture = file.parent_path() / row.name;
    if (one.has("place_m")) {
      const std::vector<double> place = one.numbers("place_m", 2, kPlace);
      row.place = LinePlace{place[0], place[1]};
    }
    rows.push_back(std::move(row));
  }
  toml.refuseUnread();
  if (rows.empty() || rows.size() > kMost)
    throw ConfigError(fmt::format("{}: has {} tables [[stand]], expected 1 to {}",
                                  printable(file.string()), rows.size(), kMost));
  return rows;
}

/// Names for drawings: pictures of several stands may have the same name in different folders.
std::vector<fs::path> numbered(const std::vector<fs::path>& pictures) {
  std::vector<fs::path> names;
  for (const fs::path& picture : pictures)
    names.emplace_back(fmt::format("{:02}-{}", names.size() + 1, picture.filename().string()));
  return names;
}

std::string tableOf(const std::vector<StandRow>& rows, const StandCalibration& found) {
  std::string text =
      fmt::format("{:<32} {:>6} {:>10} {:>9}   camera on the field{}\n", "picture", "points",
                  "median [m]", "tilt", found.scale ? "                   off the place" : "");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const StandFit& fit = found.stands[i];
    text += fmt::format("{:<32} {:>6} {:>10} {:>8.2f}\u00b0   {:<38}{}\n", printable(rows[i].name),
                        fit.points, fit.points > 0 ? fmt::format("{:.3f}", fit.median) : "-",
                        degrees(fit.tilt),
                        fmt::format("{:.2f} m, {:.2f} m, {:.0f} degrees", fit.camera.x,
                                    fit.camera.y, degrees(fit.camera.theta)),
                        fit.off ? fmt::format("{:.3f} m", *fit.off) : "");
  }
  const CameraPlace& place = found.view.place();
  text += fmt::format(
      "height {:.3f} m, sigma {:.3f}; tilt {:.2f} degrees where the sensors say 0, "
      "roll {:.2f} degrees\n",
      place.z, found.heightSigma, degrees(place.tilt), degrees(place.roll));
  if (found.scale)
    text += fmt::format("the field is {:.3f} times as large as in the world, sigma {:.3f}\n",
                        found.scale->scale, found.scale->sigma);
  else
    text += "lengths are those of the world: with place_m of three stands, they are measured\n";
  return text;
}

}  // namespace

int runCalibrateStand(const CalibrateStandArguments& arguments) {
  Outputs outputs(arguments.force);
  outputs.reads(arguments.stands);
  outputs.reads(arguments.world);
  const std::vector<StandRow> rows = readStands(arguments.stands);
  std::vector<fs::path> pictures;
  for (const StandRow& row : rows) pictures.push_back(row.picture);
  const std::vector<fs::path> names = numbered(pictures);
  announceDrawings(outputs, arguments.draw, pictures, names);
  outputs.writes("--out", arguments.out, OutputKind::kSettings);
  std::vector<Look> looks = lookAtAll(pictures);
  std::vector<Stand> stands;
  for (std::size_t i = 0; i < rows.size(); ++i)
    stands.push_back({looks[i].lines, rows[i].tilt, rows[i].place});
  const FieldModel model = fieldModelOf(*readWorld(arguments.world));
  const FieldLines lines(model.lines);
  const LinePoseSearch search(lines);
  const StandGuess guess{.height = arguments.height,
                         .heightShare = arguments.heightShare,
                         .focalShare = arguments.focal > 0.0 ? 0.05 : 0.3,
                         .focal = arguments.focal,
                         .isPlain = arguments.plain,
                         .ahead = arguments.ahead};
  const auto found = calibrateStand(looks.front().picture.size, stands, search, guess);
  if (!found) throw std::runtime_error("no line was found in any of the pictures");
  fmt::print("{}{}", tableOf(rows, *found), toText(found->verdict));
  for (std::size_t i = 0; i < looks.size() && !arguments.draw.empty(); ++i) {
    const double factor = found->scale ? found->scale->scale : 1.0;
    Pose2 pose = found->stands[i].camera;
    pose.x /= factor;
    pose.y /= factor;
    const CameraPlace& at = found->view.place();
    const CameraView view(found->view.sharedModel(),
                          {.z = at.z / factor, .tilt = found->stands[i].tilt, .roll = at.roll});
    draw(looks[i], lines, view, pose);
    writePng(outputs, drawnFile(arguments.draw, names[i]), looks[i].picture);
  }
  if (!found->verdict.isDetermined()) {
    fail("the camera is " + found->verdict.sentence() +
         (arguments.out.empty() ? "" : " (no calibration is written)"));
    return 1;
  }
  printTable(outputs, arguments.out,
             fmt::format("# pose = {{ z_m = {:.4f} }} of the [[sensor]] itself; tilt_deg where the "
                         "sensors of the tilt say 0\n[sensor.camera]\n{}",
                         found->view.place().z, toToml(found->view)));
  return 0;
}

}  // namespace ortung::app
