#include "Calibrate.hpp"
#include "CommandModule.hpp"
#include "OptionBuilder.hpp"

namespace ortung::app {
namespace {

void addCamera(Builder& build) {
  const auto a = build.command<CalibrateCameraArguments>(
      "calibrate camera", "ortung calibrate camera board*.png --board 9x6 --model fisheye",
      runCalibrateCamera);
  build.option("pictures", a->pictures, "Pictures of the board by one camera: JPEG, PNG, ...")
      .required();
  build
      .option("--board", a->board,
              "Inner corners of the board (where four squares meet): in a row x rows")
      .showsDefault();
  build.option("--model", a->model, "Kind of camera model")
      .oneOf({"perspective", "fisheye", "unified", "ocam"})
      .showsDefault();
  build.option("--out", a->out, "File to write: the table [sensor.camera] of a robot file");
  build.flag("--force", a->force, kForce);
  build.flag("--progress", a->progress, kProgress);
}

void addHeight(Builder& build, double& height, double& share) {
  build.option("--height", height, "Approximate height of the camera above the floor [m]")
      .within(0.05, 10.0)
      .showsDefault();
  build.option("--height-share", share, "Standard deviation of the height, as a share of it")
      .within(0.001, 1.0)
      .showsDefault();
}

void addLines(Builder& build) {
  const auto a = build.command<CalibrateLinesArguments>(
      "calibrate lines",
      "ortung calibrate lines cam0/*.jpg --world maps/fields/msl.toml --draw drawn",
      runCalibrateLines);
  build.option("pictures", a->pictures, "Pictures of one camera on one robot: JPEG, PNG, ...")
      .required();
  build
      .option("--world", a->worlds,
              "World with the field's lines; the best fitting one of several is used")
      .required();
  addHeight(build, a->height, a->heightShare);
  build.option("--like", a->like,
               "Calibrations of other cameras of this kind, as --out writes them: with three or "
               "more, the focal length is compared with theirs");
  build.option("--out", a->out,
               "File to write: the table [sensor.camera] of a robot file; the verdict is written "
               "beside it, to NAME.verdict.json");
  build.option("--draw", a->draw,
               "Folder for the pictures with the points that were found (red) and the field's "
               "lines as the camera would see them (blue)");
  build.flag("--force", a->force, kForce);
  build.flag("--progress", a->progress, kProgress);
}

void addStand(Builder& build) {
  const auto a = build.command<CalibrateStandArguments>(
      "calibrate stand",
      "ortung calibrate stand stands.toml --world field.toml --height 0.42 --plain",
      runCalibrateStand);
  build
      .option("stands", a->stands,
              "TOML file with a table [[stand]] for each picture: picture, tilt_deg (as joints and "
              "an inertial sensor say it), and, if known, place_m = [x, y]")
      .required();
  build.option("--world", a->world, "World with the field's lines").required();
  addHeight(build, a->height, a->heightShare);
  build.option("--focal-px", a->focal, "Approximate focal length [px]; without it, many are tried")
      .within(1.0, 100'000.0);
  build.flag("--plain", a->plain, "The lens keeps straight lines straight");
  build
      .option("--ahead", a->ahead,
              "How far the camera is ahead of what place_m is the place of [m]")
      .within(-10.0, 10.0)
      .showsDefault();
  build.option("--out", a->out, "File to write: the table [sensor.camera] of a robot file");
  build.option("--draw", a->draw,
               "Folder for the pictures with the points that were found (red) and the field's "
               "lines as the camera would see them (blue)");
  build.flag("--force", a->force, kForce);
}

void addColours(Builder& build) {
  const auto a = build.command<CalibrateColoursArguments>(
      "calibrate colours", "ortung calibrate colours cam0/*.jpg --draw drawn", runCalibrateColours);
  build.option("pictures", a->pictures, "Pictures of a field: JPEG, PNG, ...").required();
  build.option("--out", a->out, "File to write: the table [sensor.colours] of a robot file");
  build.option("--draw", a->draw,
               "Folder for the pictures with floor (green), ball (orange) and line points (red)");
  build.flag("--force", a->force, kForce);
}

}  // namespace
}  // namespace ortung::app

ORTUNG_COMMAND_MODULE(ortung::app::addCamera, ortung::app::addLines, ortung::app::addStand,
                      ortung::app::addColours)
