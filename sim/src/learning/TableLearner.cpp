#include "ortung/sim/TableLearner.hpp"

#include <cmath>
#include <list>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "ortung/base/Angles.hpp"
#include "ortung/core/PluginFactory.hpp"
#include "ortung/robot/TableInfo.hpp"
#include "ortung/sim/RobotShape.hpp"

namespace ortung {
namespace {

[[noreturn]] void fail(const char* what, double value, const char* expected) {
  throw std::invalid_argument(std::string(what) + " is " + std::to_string(value) + ", expected " +
                              expected);
}

}  // namespace

void TableLearner::Settings::check() const {
  if (!(cell >= 1e-3 && cell <= 10.0)) fail("cell", cell, "0.001 to 10 m");
  const double steps = 360.0 / headingStepDeg;
  const bool isRange = headingStepDeg >= 1e-3 && headingStepDeg <= 360.0;
  if (!isRange || std::abs(steps - std::round(steps)) > 1e-6)
    fail("heading step", headingStepDeg, "degrees that divide a turn, e.g. 1, 2 or 2.5");
  if (threads < 1 || threads > 256) fail("threads", threads, "1 to 256");
}

struct TableLearner::Parts {
  Parts(std::unique_ptr<SimWorld> given, RobotConfig config, const Settings& settings)
      : world(std::move(given)),
        robot(std::move(config)),
        options{settings.cell, kTurn / std::round(360.0 / settings.headingStepDeg)},
        area(learnAreaOf(*world, settings.cell, sizeOf(robot), settings.area)) {
    // A thread that generates needs a robot of its own, beside the one that learns.
    const std::size_t rigs = settings.threads > 1 ? settings.threads + 1 : 1;
    for (std::size_t i = 0; i < rigs; ++i) {
      containers.emplace_back();
      devices.push_back(fillContainer(containers.back(), robot, factory));
    }
    learner = std::make_unique<Learner>(*world, area.region, devices.front(),
                                        std::span(devices).subspan(1), factory, options);
  }

  PluginFactory factory{PluginFactory::standardFolders()};
  std::unique_ptr<SimWorld> world;
  RobotConfig robot;
  LearnOptions options;
  LearnArea area;
  std::list<SensorContainer> containers;  ///< containers of all rigs; the first one learns
  std::vector<std::vector<Device>> devices;
  std::unique_ptr<Learner> learner;
};

TableLearner::TableLearner(std::unique_ptr<SimWorld> world, RobotConfig robot,
                           const Settings& settings) {
  settings.check();
  parts_ = std::make_unique<Parts>(std::move(world), std::move(robot), settings);
}

TableLearner::~TableLearner() = default;

Learner& TableLearner::learner() { return *parts_->learner; }
const SimWorld& TableLearner::world() const { return *parts_->world; }
const RobotConfig& TableLearner::robot() const { return parts_->robot; }
const FieldRegion& TableLearner::region() const { return parts_->area.region; }
double TableLearner::leftOut() const { return parts_->area.leftOut; }

std::uintmax_t TableLearner::write(const std::filesystem::path& out) const {
  const TableInfo info =
      tableInfoOf(*parts_->world, parts_->robot, parts_->area.region, parts_->options);
  return writeTables(out, parts_->containers.front(), info);
}

}  // namespace ortung
