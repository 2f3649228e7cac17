#include "LearnParts.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <list>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "Interrupt.hpp"
#include "Progress.hpp"
#include "RobotSettings.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/robot/RobotFile.hpp"
#include "ortung/sim/Learner.hpp"
#include "ortung/sim/RobotShape.hpp"

namespace ortung::app {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kWordsAnArray = std::size_t{1} << 22;  ///< of readings in a part

std::string arrayName(std::size_t number) { return fmt::format("readings.{:05}", number); }

/// World, robot and learner of the command's arguments, as the player `learner` makes them.
class Desk {
 public:
  explicit Desk(const LearnArguments& arguments)
      : arguments_(arguments),
        world_(readWorld(arguments.world)),
        robot_(readRobot(arguments.robot)),
        options_{arguments.cell, kTurn / std::round(360.0 / arguments.headingStepDeg)},
        region_(learnAreaOf(*world_, arguments.cell, sizeOf(robot_), areaOf(arguments)).region) {
    // A thread that generates needs a robot of its own, beside the one that learns.
    const std::size_t rigs = arguments.threads > 1 ? arguments.threads + 1 : 1;
    for (std::size_t i = 0; i < rigs; ++i) {
      containers_.emplace_back();
      devices_.push_back(fillContainer(containers_.back(), robot_, factory_));
    }
    learner_ = std::make_unique<Learner>(*world_, region_, devices_.front(),
                                         std::span(devices_).subspan(1), factory_, options_);
  }

  Learner& learner() { return *learner_; }
  std::string needs() const {
    return Json{{"world", arguments_.world.string()},
                {"robot", arguments_.robot.string()},
                {"cell_m", arguments_.cell},
                {"heading_step_deg", arguments_.headingStepDeg},
                {"area", arguments_.area},
                {"set", arguments_.settings}}
        .dump(-1, ' ', true, Json::error_handler_t::replace);
  }
  std::uintmax_t write(const std::filesystem::path& out) const {
    return writeTables(out, containers_.front(), tableInfoOf(*world_, robot_, region_, options_));
  }

 private:
  const LearnArguments& arguments_;
  PluginFactory factory_{PluginFactory::standardFolders()};
  std::unique_ptr<SimWorld> world_;
  RobotConfig robot_;
  LearnOptions options_;
  FieldRegion region_;
  std::list<SensorContainer> containers_;
  std::vector<std::vector<Device>> devices_;
  std::unique_ptr<Learner> learner_;
};

/// Writes readings in arrays of some size.
class ReadingsWriter {
 public:
  explicit ReadingsWriter(TableWriter& file) : file_(file) {}
  void add(std::span<const std::uint32_t> words) {
    words_.insert(words_.end(), words.begin(), words.end());
    if (words_.size() >= kWordsAnArray) flush();
  }
  void flush() {
    if (words_.empty()) return;
    // NumPy's unsigned words are not among the types of tables; the bits are the same.
    const std::span signedWords(reinterpret_cast<const std::int32_t*>(words_.data()),
                                words_.size());
    file_.add(arrayName(arrays_++), {words_.size()}, signedWords);
    words_.clear();
  }

 private:
  TableWriter& file_;
  std::vector<std::uint32_t> words_;
  std::size_t arrays_ = 0;
};

/// Returns the arguments with which the parts were made. @throws PartError
LearnArguments argumentsOf(const PartSet& parts) {
  LearnArguments arguments;
  try {
    const Json needs = Json::parse(parts.head().needs);
    arguments.world = needs.at("world").get<std::string>();
    arguments.robot = needs.at("robot").get<std::string>();
    arguments.cell = needs.at("cell_m");
    arguments.headingStepDeg = needs.at("heading_step_deg");
    arguments.area = needs.at("area");
    arguments.settings = needs.at("set").get<std::vector<std::string>>();
  } catch (const Json::exception& error) {
    throw PartError({std::string("the parts do not say how they were made: ") + error.what()});
  }
  return arguments;
}

}  // namespace

void learnShard(const LearnArguments& arguments, const Shard& shard,
                const std::filesystem::path& out) {
  Desk desk(arguments);
  PartWriter part(out, {kLearnParts, arguments.job, shard, desk.needs()});
  ReadingsWriter readings(part.content());
  desk.learner().passOn(shard.number, shard.count,
                        [&](std::span<const std::uint32_t> words) { readings.add(words); });
  {
    Progress progress("generating readings", arguments.progress);
    while (desk.learner().step()) {
      checkInterrupt();
      progress.update(desk.learner().share());
    }
  }
  readings.flush();
  part.commit();
  fmt::print("{}: part {} of what {} learns in {}\n", out.string(), toText(shard),
             arguments.robot.string(), arguments.world.string());
}

void mergeLearned(const PartSet& parts, const std::filesystem::path& out, bool progress) {
  const LearnArguments arguments = argumentsOf(parts);
  parts.requireInputs();
  applySettings(arguments.robot, arguments.settings);
  Desk desk(arguments);
  Progress bar("learning", progress);
  try {
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const TableFile part = parts.open(i);
      for (std::size_t k = 0; k < part.arrays().size(); ++k) {
        checkInterrupt();
        const auto words = part.get<std::int32_t>(arrayName(k), {0});
        desk.learner().learnFrom(
            {reinterpret_cast<const std::uint32_t*>(words.data()), words.size()});
        bar.update(desk.learner().share());
      }
    }
    desk.learner().endLearning();
  } catch (const std::invalid_argument& error) {
    throw PartError({std::string("the parts are not whole: ") + error.what()});
  }
  const std::uintmax_t bytes = desk.write(out);
  fmt::print("{}: tables of {} parts, {:.1f} MB\n", out.string(), parts.size(),
             static_cast<double>(bytes) / 1e6);
}

}  // namespace ortung::app
