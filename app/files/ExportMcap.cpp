#include "ExportMcap.hpp"

#include <fmt/format.h>

#include <map>
#include <optional>
#include <stdexcept>

#include "Console.hpp"
#include "Interrupt.hpp"
#include "Localizing.hpp"
#include "Outputs.hpp"
#include "Progress.hpp"
#include "PublishedRecord.hpp"
#include "ScratchFolder.hpp"
#include "SourceArguments.hpp"
#include "WorldGrid.hpp"
#include "ortung/base/NewFile.hpp"
#include "ortung/robot/TableInfo.hpp"
#include "ortung/robot/TomlFile.hpp"
#include "ortung/ros2/McapWriter.hpp"
#include "ortung/ros2/RobotTopics.hpp"
#include "ortung/run/Robot.hpp"

namespace ortung::app {
namespace {

constexpr std::int8_t kFreeCell = 0;
constexpr std::int8_t kOccupiedCell = 100;
constexpr std::int8_t kUnknownCell = -1;

ros2::OccupancyGrid mapOf(const WorldGrid& grid) {
  ros2::OccupancyGrid map;
  map.resolution = static_cast<float>(grid.cell);
  map.width = static_cast<std::uint32_t>(grid.columns);
  map.height = static_cast<std::uint32_t>(grid.rows);
  map.origin.position = {grid.originX, grid.originY, 0.0};
  for (const char cell : grid.cells)
    map.data.push_back(cell == WorldGrid::kFree       ? kFreeCell
                       : cell == WorldGrid::kOccupied ? kOccupiedCell
                                                      : kUnknownCell);
  return map;
}

/// Open cells are free, the cells at their edge occupied: tables know no more of a world.
ros2::OccupancyGrid mapOf(const FieldRegion& region) {
  const FieldGrid& grid = region.grid;
  ros2::OccupancyGrid map;
  map.resolution = static_cast<float>(grid.cell);
  map.width = static_cast<std::uint32_t>(grid.columns);
  map.height = static_cast<std::uint32_t>(grid.rows);
  map.origin.position = {grid.originX, grid.originY, 0.0};
  const auto isOpen = [&](int column, int row) {
    return column >= 0 && row >= 0 && column < grid.columns && row < grid.rows &&
           region.open[static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.columns) +
                       static_cast<std::size_t>(column)] != 0;
  };
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      bool isEdge = false;
      for (int i = 0; i < 9; ++i) isEdge |= isOpen(column + i % 3 - 1, row + i / 3 - 1);
      map.data.push_back(isOpen(column, row) ? kFreeCell : isEdge ? kOccupiedCell : kUnknownCell);
    }
  }
  return map;
}

std::optional<ros2::OccupancyGrid> mapOf(const ExportMcapArguments& arguments) {
  if (!arguments.world.empty())
    return mapOf(drawGrid(*readWorld(arguments.world), arguments.cell, arguments.height));
  if (!arguments.tables.empty()) return mapOf(readTableInfo(TableFile(arguments.tables)).region);
  return std::nullopt;
}

ros2::RobotTopics::MapFrame mapFrameOf(const std::string& name) {
  if (name == "truth") return ros2::RobotTopics::MapFrame::kTruth;
  if (name == "none") return ros2::RobotTopics::MapFrame::kNone;
  return ros2::RobotTopics::MapFrame::kBest;
}

/// Whoever plays the file to others gives what is latched to those who come later, too.
constexpr const char* kLatchedQos =
    "- history: 1\n  depth: 1\n  reliability: 1\n  durability: 1\n"
    "  deadline:\n    sec: 9223372036\n    nsec: 854775807\n"
    "  lifespan:\n    sec: 9223372036\n    nsec: 854775807\n"
    "  liveliness: 1\n  liveliness_lease_duration:\n    sec: 9223372036\n    nsec: 854775807\n"
    "  avoid_ros_namespace_conventions: false";

/// The file, whose channels appear with their first messages.
class BagFile {
 public:
  BagFile(const std::filesystem::path& file, const ros2::RobotTopics& topics)
      : topics_(topics),
        file_(file),
        writer_([this](std::string_view bytes) { file_.write(bytes); }, {}) {}

  void write(std::size_t topic, Timestamp stamp, std::string_view cdr) {
    auto channel = channels_.find(topic);
    if (channel == channels_.end()) channel = channels_.emplace(topic, add(topic)).first;
    writer_.write(channel->second, static_cast<std::uint64_t>(stamp) * 1000, cdr);
    ++counts_[topic];
  }
  void attach(std::string_view name, std::string_view type, std::string_view bytes) {
    writer_.attach(name, type, bytes);
  }
  void finish() {
    writer_.finish();
    file_.commit();
  }
  const std::map<std::size_t, std::size_t>& counts() const { return counts_; }

 private:
  std::uint16_t add(std::size_t number) {
    const ros2::Topic& topic = topics_.topics()[number];
    auto schema = schemas_.find(topic.type);
    if (schema == schemas_.end())
      schema = schemas_
                   .emplace(topic.type,
                            writer_.addSchema(topic.type, "ros2msg", ros2::schemaText(topic.type)))
                   .first;
    std::map<std::string, std::string> metadata;
    if (!topic.feature.empty()) metadata["ortung_feature"] = topic.feature;
    if (!topic.format.empty()) metadata["format"] = topic.format;
    if (topic.isLatched) metadata["offered_qos_profiles"] = kLatchedQos;
    return writer_.addChannel(schema->second, topic.name, "cdr", metadata);
  }

  const ros2::RobotTopics& topics_;
  NewFile file_;
  ros2::McapWriter writer_;
  std::map<std::string_view, std::uint16_t> schemas_;
  std::map<std::size_t, std::uint16_t> channels_;
  std::map<std::size_t, std::size_t> counts_;
};

/// Copies all moments. @returns whether there was one
bool copyMoments(Source& source, const ExportMcapArguments& arguments, const std::string& robotToml,
                 ros2::RobotTopics& topics, BagFile& file) {
  const auto sink = [&](std::size_t topic, Timestamp stamp, std::string_view cdr) {
    file.write(topic, stamp, cdr);
  };
  const auto map = mapOf(arguments);
  Progress progress("exporting", arguments.progress);
  FrameReader frames(source);
  std::vector<Message> frame;
  bool isAny = false;
  while (unlessInterrupted(source, [&] { return frames.next(frame); })) {
    const Timestamp stamp = frame.front().stamp;
    try {
      if (!isAny) {
        file.attach("robot.toml", "application/toml", robotToml);
        topics.start(stamp, sink);
        if (map) topics.show(*map, stamp, sink);
      }
      topics.take(frame, sink);
    } catch (const std::invalid_argument& error) {
      throw std::runtime_error(
          fmt::format("{}: reading at {} us: {}", arguments.source, stamp, error.what()));
    }
    isAny = true;
    progress.update(source.progress());
  }
  return isAny;
}

}  // namespace

namespace {

/// Localizes, and returns the record of the readings and the results.
std::filesystem::path localized(const ExportMcapArguments& arguments,
                                const std::filesystem::path& folder) {
  LocalizationArguments localization;
  localization.source = arguments.source;
  localization.robot = arguments.robot;
  localization.tables = arguments.tables;
  localization.start = arguments.start;
  localization.seed = arguments.seed;
  localization.publish = true;
  const auto run = openLocalization(localization);
  PublishedRecord record(folder / "localized.rec", *run);
  Progress progress("localizing", arguments.progress);
  std::size_t updates = 0;
  while (nextStep(*run, localization)) {
    ++updates;
    record.writePublished();
    progress.update(run->feeder().progress());
  }
  requireUpdates(updates, localization);
  record.commit();
  return folder / "localized.rec";
}

}  // namespace

int runExportMcap(const ExportMcapArguments& arguments) {
  if (arguments.localizes && arguments.tables.empty())
    throw UsageError("--localize needs --tables");
  if (!arguments.world.empty() && !arguments.tables.empty())
    throw UsageError("--world and --tables are both given; the map comes from one of them");
  Outputs outputs(arguments.force);
  outputs.readsSource(arguments.source);
  for (const auto& input : {arguments.robot, arguments.tables, arguments.world})
    outputs.reads(input);
  outputs.writes("--out", arguments.out, OutputKind::kMcap);
  const std::unique_ptr<Robot> robot = openRobot(arguments.robot);
  const ScratchFolder scratch;
  const std::string played = arguments.localizes
                                 ? "record:" + localized(arguments, scratch.path()).string()
                                 : arguments.source;
  const auto source = openSourceArgument(played, arguments.robot, robot->factory);
  ros2::RobotTopics topics(robot->container, {mapFrameOf(arguments.mapFrame), ""});
  BagFile file(outputs.ready(arguments.out), topics);
  if (!copyMoments(*source, arguments, readTomlText(arguments.robot), topics, file))
    throw std::runtime_error(arguments.source + ": holds no reading");
  file.finish();
  warnOf(*source);
  std::size_t messages = 0;
  for (const auto& [topic, count] : file.counts()) messages += count;
  fmt::print("{}: {} messages\n", printable(arguments.out.string()), messages);
  for (const auto& [topic, count] : file.counts())
    fmt::print("  {:<32} {:<42} {:>9}\n", topics.topics()[topic].name, topics.topics()[topic].type,
               count);
  return 0;
}

}  // namespace ortung::app
