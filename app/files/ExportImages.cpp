#include "ExportImages.hpp"

#include <fmt/format.h>

#include <limits>
#include <optional>
#include <stdexcept>

#include "Console.hpp"
#include "Interrupt.hpp"
#include "Outputs.hpp"
#include "PictureParts.hpp"
#include "PictureSet.hpp"
#include "Progress.hpp"
#include "ScratchFolder.hpp"
#include "SourceArguments.hpp"
#include "ortung/formats/FeatureOf.hpp"
#include "ortung/formats/FormatNames.hpp"
#include "ortung/formats/PoseData.hpp"
#include "ortung/pictures/CameraPicture.hpp"
#include "ortung/robot/RobotFile.hpp"
#include "ortung/sim/SceneRun.hpp"
#include "ortung/sim/SimulatedRun.hpp"

namespace ortung::app {
namespace {

constexpr std::uint64_t kPlaces = 0x706963;  ///< stream of chance: where --anywhere puts the robot

/// A camera of a robot, and what its [[sensor]] says.
struct Eye {
  ImageData* data = nullptr;
  double period = 0.1;     ///< [s]
  double variation = 0.0;  ///< of the robot file
  std::uint64_t seed = 0;
  std::unique_ptr<CameraPicture> picture;
  Timestamp due = 0;
  std::size_t seen = 0;  ///< pictures, with those that are left out
  std::string name() const { return toText(data->id()); }
};

/// The calibrated cameras of a robot that the query names.
std::vector<Eye> eyesOf(const SensorContainer& container, const RobotConfig& robot,
                        const std::string& query) {
  std::vector<Eye> eyes;
  const std::string text = query.empty() ? "*/*/*" : query;
  for (SensorData* data : container.findAll(parseSensorQuery(text))) {
    // A calibration is more than parameters of a format can tell: it is asked of the class.
    auto* image = dynamic_cast<ImageData*>(data);
    if (image == nullptr || !image->camera()) continue;
    Eye& eye = eyes.emplace_back();
    eye.data = image;
    for (const SensorConfig& sensor : robot.sensors) {
      const Parameters& p = sensor.parameters;
      if (sensor.plugin != "camera" || sensorIdOf(p, {"camera", "camera", "image"}) != data->id())
        continue;
      eye.period = p.numberOr("period_s", eye.period, {0.0, 3600.0});
      eye.variation = p.numberOr("variation", 0.0, {0.0, 1.0});
      eye.seed = static_cast<std::uint64_t>(p.integerOr("seed", 0, {0.0, 9e15}));
    }
  }
  if (eyes.empty())
    throw std::runtime_error(fmt::format("robot {} has no calibrated camera{}", robot.name,
                                         query.empty() ? "" : " " + query));
  return eyes;
}

class Exporter {
 public:
  explicit Exporter(const ExportImagesArguments& arguments)
      : arguments_(arguments),
        shard_(arguments.shard.empty() ? Shard() : readShard(arguments.shard)),
        outputs_(arguments.force) {
    // A part is one file: its pictures are put together somewhere else.
    if (isPart()) {
      outputs_.writes("--out", arguments.out, OutputKind::kPart);
      scratch_.emplace();
    }
    set_.emplace(isPart() ? scratch_->path() : arguments.out, arguments.force);
  }

  bool isDone() const {
    return number_ >= static_cast<std::size_t>(arguments_.count) || interruptSignal() != 0;
  }
  bool isWanted(Eye& eye) const {
    return eye.seen++ % static_cast<std::size_t>(arguments_.every) == 0;
  }

  /// Draws what the camera sees now.
  void draw(Eye& eye, const World& world, const std::string& worldName, const Pose2& robot,
            RobotNumber self) {
    const std::size_t number = number_++;
    if (!shard_.has(number)) return;
    const double strength = arguments_.variation.value_or(eye.variation);
    const std::uint64_t seed = arguments_.seed ? *arguments_.seed + number : eye.seed;
    if (!eye.picture)
      eye.picture = std::make_unique<CameraPicture>(*eye.data->camera(), Variation{strength, seed});
    else if (arguments_.seed)
      eye.picture->setVariation({strength, seed});
    const Pose2 sensor = robot * eye.data->mount();
    eye.picture->take(world, sensor, self, CameraPicture::Noise{seed, number}, words_);
    eye.data->setData(0, words_);
    annotate(eye, world, sensor, self);
    PictureNotes notes = notesOf(eye, sensor, "simulation");
    notes.location = worldName;
    notes.annotations = annotationsOf(things_, world, *eye.data->camera(), sensor);
    set_->add(number, std::move(notes), eye.data->reading(), things_, ranges_);
  }

  /// Takes over a picture that was recorded. @param world may be null @param robot if known
  void copy(Eye& eye, const World* world, const std::optional<Pose2>& robot) {
    const std::size_t number = number_++;
    if (!shard_.has(number)) return;
    std::optional<Pose2> sensor;
    if (robot) sensor = *robot * eye.data->mount();
    things_.clear();
    ranges_.clear();
    PictureNotes notes = notesOf(eye, sensor, "record");
    if (world != nullptr && sensor) {
      if (!eye.picture) eye.picture = std::make_unique<CameraPicture>(*eye.data->camera());
      annotate(eye, *world, *sensor, 0);
      notes.annotations = annotationsOf(things_, *world, *eye.data->camera(), *sensor);
    }
    set_->add(number, std::move(notes), eye.data->reading(), things_, ranges_);
  }

  int finish() {
    const std::size_t own = set_->numbers().size();
    if (isPart()) {
      checkInterrupt();  // a part that lacks pictures would be joined with others
      writePictures(*set_, scratch_->path(), {kPictureParts, arguments_.job, shard_},
                    outputs_.ready(arguments_.out));
      fmt::print("{}: part {}, {} of {} pictures\n", printable(arguments_.out.string()),
                 toText(shard_), own, number_);
      return 0;
    }
    set_->finish();
    fmt::print("{}: {} pictures\n", printable(arguments_.out.string()), own);
    return 0;
  }

 private:
  PictureNotes notesOf(const Eye& eye, const std::optional<Pose2>& sensor, const char* tag) const {
    PictureNotes notes;
    notes.sensor = sensor;
    notes.camera = &*eye.data->camera();
    notes.set = eye.name();
    notes.tag = tag;
    return notes;
  }
  void annotate(Eye& eye, const World& world, const Pose2& sensor, RobotNumber self) {
    const ImageSize size = eye.data->camera()->model().size();
    const auto pixels =
        static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height);
    things_.resize(pixels);
    ranges_.resize(pixels);
    eye.picture->annotate(world, sensor, self, things_, ranges_);
  }

  bool isPart() const { return !arguments_.shard.empty(); }

  const ExportImagesArguments& arguments_;
  Shard shard_;
  Outputs outputs_;
  std::optional<ScratchFolder> scratch_;
  std::optional<PictureSet> set_;
  std::size_t number_ = 0;  ///< of the next picture, whatever shard has it
  std::vector<std::uint32_t> words_;
  std::vector<std::uint32_t> things_;
  std::vector<float> ranges_;
};

/// Carries the robot to a place drawn at random.
void carry(Simulation& simulation, SimRobot& robot, Random& random) {
  constexpr int kTries = 1000;
  const Box2 bounds = simulation.world().solids().bounds;
  for (int i = 0; i < kTries; ++i) {
    const Pose2 pose{random.uniform(bounds.xLow, bounds.xHigh),
                     random.uniform(bounds.yLow, bounds.yHigh), random.uniform(-3.14, 3.14)};
    try {
      simulation.place(robot, pose);
      return;
    } catch (const NoRoom&) {
      continue;
    }
  }
  throw std::runtime_error("robot " + robot.config().name + ": found no room to be carried to");
}

int exportSimulated(const ExportImagesArguments& arguments, const SourceText& source) {
  Parameters options("sim:" + source.path);
  options.set("path", source.path);
  options.set("robot_file", arguments.robot.string());
  for (const auto& [key, value] : source.options) options.set(key, value);
  const SimulatedRun wanted = SimulatedRun::read(options);
  options.refuseUnread();
  PluginFactory factory(PluginFactory::standardFolders());
  SceneRun run(wanted.scene, wanted.config, factory);
  Simulation& simulation = run.simulation();
  const auto found = wanted.robot.empty() && !simulation.robots().empty()
                         ? std::optional<std::size_t>(0)
                         : run.find(wanted.robot);
  if (!found) throw UsageError("robot '" + wanted.robot + "' is not in the scene");
  SimRobot& robot = *simulation.robots()[*found];
  const RobotNumber number = robot.state().number;
  std::vector<Eye> eyes = eyesOf(robot.container(), robot.config(), arguments.camera);
  Random places = simulation.random(kPlaces);
  Exporter exporter(arguments);
  Progress progress("exporting", arguments.progress);
  while (!exporter.isDone() && simulation.now() <= wanted.duration) {
    run.act();
    if (simulation.find(number) == nullptr)
      throw std::runtime_error("the robot has left the field");
    for (Eye& eye : eyes) {
      if (simulation.now() < eye.due || exporter.isDone()) continue;
      eye.due = std::max(eye.due + fromSeconds(eye.period), simulation.now() + 1);
      if (!exporter.isWanted(eye)) continue;
      if (arguments.anywhere) carry(simulation, robot, places);
      exporter.draw(eye, simulation.world(), simulation.world().name(), robot.state().pose, number);
    }
    run.move();
    progress.update(std::min(toSeconds(simulation.now()) / toSeconds(wanted.duration), 1.0));
  }
  return exporter.finish();
}

int exportRecorded(const ExportImagesArguments& arguments) {
  PluginFactory factory(PluginFactory::standardFolders());
  const auto source = openSourceArgument(arguments.source, arguments.robot, factory);
  const RobotConfig robot =
      !arguments.robot.empty()
          ? readRobot(arguments.robot)
          : throw UsageError(
                "--robot is missing: which cameras the pictures are of, the robot file says");
  SensorContainer container;
  fillContainer(container, robot, factory);
  std::vector<Eye> eyes = eyesOf(container, robot, arguments.camera);
  const auto world =
      arguments.world.empty() ? std::unique_ptr<SimWorld>() : readWorld(arguments.world);
  const SensorData* truth = container.find({.type = "groundTruth"});
  Exporter exporter(arguments);
  Progress progress("exporting", arguments.progress);
  FrameReader frames(*source);
  std::vector<Message> frame;
  while (!exporter.isDone() && frames.next(frame)) {
    std::optional<Pose2> pose;
    for (const Message& message : frame) {
      SensorData* data = container.findExactly(message.id);
      if (data == nullptr) continue;
      if (data == truth || isOf(*data, formats::kImage))
        data->setData(message.stamp, message.words);
      if (data == truth) pose = readingAs<PoseData>(*truth);
    }
    for (Eye& eye : eyes)
      if (eye.data->sequence() > 0 && eye.data->stamp() == frame.front().stamp &&
          !exporter.isDone() && exporter.isWanted(eye))
        exporter.copy(eye, world.get(), pose);
    progress.update(source->progress());
  }
  warnOf(*source);
  return exporter.finish();
}

}  // namespace

int runExportImages(const ExportImagesArguments& arguments) {
  SourceText source;
  try {
    source = parseSourceText(arguments.source);
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
  if (source.kind == "sim") return exportSimulated(arguments, source);
  if (arguments.seed || arguments.variation || arguments.anywhere)
    throw UsageError("--seed, --variation and --anywhere are for sim: sources, which are drawn");
  return exportRecorded(arguments);
}

}  // namespace ortung::app
