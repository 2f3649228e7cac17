#include "LearnParts.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "Interrupt.hpp"
#include "Progress.hpp"
#include "RobotSettings.hpp"
#include "ortung/robot/RobotFile.hpp"
#include "ortung/sim/TableLearner.hpp"

namespace ortung::app {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kWordsAnArray = std::size_t{1} << 22;  ///< of readings in a part

std::string arrayName(std::size_t number) { return fmt::format("readings.{:05}", number); }

/// Returns what learns by the command's arguments.
TableLearner learnerOf(const LearnArguments& arguments) {
  return TableLearner(
      readWorld(arguments.world), readRobot(arguments.robot),
      {arguments.cell, arguments.headingStepDeg, areaOf(arguments), arguments.threads});
}

/// Returns the arguments as parts keep them.
std::string needsOf(const LearnArguments& arguments) {
  return Json{{"world", arguments.world.string()},
              {"robot", arguments.robot.string()},
              {"cell_m", arguments.cell},
              {"heading_step_deg", arguments.headingStepDeg},
              {"area", arguments.area},
              {"set", arguments.settings}}
      .dump(-1, ' ', true, Json::error_handler_t::replace);
}

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
  TableLearner tables = learnerOf(arguments);
  PartWriter part(out, {kLearnParts, arguments.job, shard, needsOf(arguments)});
  ReadingsWriter readings(part.content());
  tables.learner().passOn(shard.number, shard.count,
                          [&](std::span<const std::uint32_t> words) { readings.add(words); });
  {
    Progress progress("generating readings", arguments.progress);
    while (tables.learner().step()) {
      checkInterrupt();
      progress.update(tables.learner().share());
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
  TableLearner tables = learnerOf(arguments);
  Progress bar("learning", progress);
  try {
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const TableFile part = parts.open(i);
      for (std::size_t k = 0; k < part.arrays().size(); ++k) {
        checkInterrupt();
        const auto words = part.get<std::int32_t>(arrayName(k), {0});
        tables.learner().learnFrom(
            {reinterpret_cast<const std::uint32_t*>(words.data()), words.size()});
        bar.update(tables.learner().share());
      }
    }
    tables.learner().endLearning();
  } catch (const std::invalid_argument& error) {
    throw PartError({std::string("the parts are not whole: ") + error.what()});
  }
  const std::uintmax_t bytes = tables.write(out);
  fmt::print("{}: tables of {} parts, {:.1f} MB\n", out.string(), parts.size(),
             static_cast<double>(bytes) / 1e6);
}

}  // namespace ortung::app
