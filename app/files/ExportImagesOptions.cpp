#include "CommandModule.hpp"
#include "ExportImages.hpp"
#include "OptionBuilder.hpp"

namespace ortung::app {
namespace {

void addExportImages(Builder& build) {
  const auto a = build.command<ExportImagesArguments>(
      "export images",
      "ortung export images 'sim:maps/fields/msl.toml?duration=100' --robot "
      "maps/robots/msl_camera.toml --out pictures --anywhere --seed 1 --variation 0.5",
      runExportImages);
  build
      .option("source", a->source,
              "sim:FILE?key=value (a world or a scene), or a source with pictures, as "
              "record:run.rec")
      .required();
  build.option("--robot", a->robot, "Robot file (TOML); a scene has its own");
  build.option("--out", a->out, "Folder to write: images, segmentations, depth, annotations.yaml")
      .required();
  build.option("--world", a->world,
               "World file of a record: what stands in it is told of its pictures, too");
  build.option("--camera", a->camera, "model/type/feature of the camera; default: all");
  build.option("--every", a->every, "Every n-th picture of each camera")
      .within(1, 1e9)
      .showsDefault();
  build.option("--count", a->count, "How many pictures at most").within(1, 1e9);
  build
      .option("--variation", a->variation,
              "How far light, floor, exposure, blur and noise may be from plain ones, 0 to 1; "
              "default: the robot file's")
      .within(0.0, 1.0);
  build.option("--seed", a->seed,
               "Seed of the first picture's look; each picture has one of its own");
  build.flag("--anywhere", a->anywhere, "Take each picture from a place at random");
  build.shard(a->shard, a->job);
  build.flag("--force", a->force, "Write into a folder that has something in it");
  build.flag("--progress", a->progress, kProgress);
}

}  // namespace
}  // namespace ortung::app

ORTUNG_COMMAND_MODULE(ortung::app::addExportImages)
