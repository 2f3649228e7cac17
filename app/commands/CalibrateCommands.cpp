#include "CalibrateCommands.hpp"

#include "Calibrate.hpp"
#include "OptionBuilder.hpp"

namespace ortung::app {
namespace {

void addNoise(Builder& build, CLI::App& app) {
  const auto a = build.command<CalibrateNoiseArguments>(
      app, "noise",
      "Each sensor's noise, outliers, biases, latency and mount from logs of the robot",
      "ortung calibrate noise run1.rec run2.rec --robot robot.toml --tables hall.ortung --out "
      "learned.toml",
      runCalibrateNoise);
  build.option("sources", a->sources, "Records, or sources KIND:PATH?key=value")->required();
  build.option("--robot", a->robot, "Robot file (TOML)")->required();
  build.option("--tables", a->tables, "Table file of `ortung learn`")->required();
  build.option("--out", a->out, "Robot file to write: the same with what was learned");
  build
      .option("--reference", a->reference,
              "Where the robot was: truth, the track that MCL finds, or auto: truth where there is "
              "one")
      ->check(CLI::IsMember({"auto", "truth", "track"}))
      ->capture_default_str();
  build.option("--fixed", a->fixed, "What is not learned: bias, mount, latency")
      ->check(CLI::IsMember({"bias", "mount", "latency"}))
      ->delimiter(',');
  build.option("--motion", a->motion,
               "File with [motion] for the track; default: the robot file's");
  build.option("--seed", a->seed, "Seed of the track")->capture_default_str();
  build.flag("--any-world", a->anyWorld,
             "Go on although a source comes from another world than the tables");
  build.flag("--force", a->force, kForce);
  build.flag("--progress", a->progress, kProgress);
}

#ifdef ORTUNG_HAS_VISION
void addLines(Builder& build, CLI::App& app) {
  const auto a = build.command<CalibrateLinesArguments>(
      app, "lines",
      "A camera's focal length, distortion, height and tilt from the lines of a soccer field in "
      "its pictures alone",
      "ortung calibrate lines cam0/*.jpg --world maps/fields/msl.toml --draw drawn",
      runCalibrateLines);
  build.option("pictures", a->pictures, "Pictures of one camera on one robot: JPEG, PNG, ...")
      ->required();
  build
      .option("--world", a->worlds,
              "World with the field's lines; of several the one that fits best is taken")
      ->required();
  build.option("--height", a->height, "About how high the camera is above the floor [m]")
      ->check(within(0.05, 10.0))
      ->capture_default_str();
  build.option("--height-share", a->heightShare, "How far off that may be, as a share (sigma)")
      ->check(within(0.001, 1.0))
      ->capture_default_str();
  build.option("--out", a->out, "File to write: the table [sensor.camera] of a robot file");
  build.option("--draw", a->draw,
               "Folder for the pictures with the points that were found (red) and the field's "
               "lines as the camera would see them (blue)");
  build.flag("--force", a->force, kForce);
  build.flag("--progress", a->progress, kProgress);
}

void addCamera(Builder& build, CLI::App& app) {
  const auto a = build.command<CalibrateCameraArguments>(
      app, "camera", "A camera's model from pictures of a chessboard",
      "ortung calibrate camera board*.png --board 9x6 --model fisheye", runCalibrateCamera);
  build.option("pictures", a->pictures, "Pictures of the board by one camera: JPEG, PNG, ...")
      ->required();
  build
      .option("--board", a->board,
              "Inner corners of the board, in a row and rows: where four squares meet")
      ->capture_default_str();
  build.option("--model", a->model, "What kind of camera it is")
      ->check(CLI::IsMember({"perspective", "fisheye", "unified", "ocam"}))
      ->capture_default_str();
  build.option("--out", a->out, "File to write: the table [sensor.camera] of a robot file");
  build.flag("--force", a->force, kForce);
  build.flag("--progress", a->progress, kProgress);
}

void addColours(Builder& build, CLI::App& app) {
  const auto a = build.command<CalibrateColoursArguments>(
      app, "colours", "The floor's colour in pictures of a field, in its light",
      "ortung calibrate colours cam0/*.jpg --draw drawn", runCalibrateColours);
  build.option("pictures", a->pictures, "Pictures of a field: JPEG, PNG, ...")->required();
  build.option("--out", a->out, "File to write: the table [sensor.colours] of a robot file");
  build.option("--draw", a->draw,
               "Folder for the pictures with floor (green), ball (orange) and line points (red)");
  build.flag("--force", a->force, kForce);
}

#endif

}  // namespace

void addCalibrate(Builder& build, CLI::App& app) {
  CLI::App* calibrate = app.add_subcommand("calibrate", "Find out how sensors err and cameras see");
  calibrate->require_subcommand(1);
  calibrate->footer("Example:\n  ortung calibrate lines cam0/*.jpg --world maps/fields/msl.toml");
  addNoise(build, *calibrate);
#ifdef ORTUNG_HAS_VISION
  addCamera(build, *calibrate);
  addLines(build, *calibrate);
  addColours(build, *calibrate);
#endif
}

}  // namespace ortung::app
