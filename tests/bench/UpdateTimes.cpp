/// How long updates take on logs, beside budget_ms: by nominal times, by the clock, and by the
/// clock while another thread computes maps of probability without a pause.
///
///     update_times FOLDER BUDGET_MS NAME...
///
/// For each NAME, FOLDER has NAME.rec (with ground truth), NAME-robot.toml and NAME.ortung, as
/// scripts/evaluate.py leaves them. The start is global, and halfway the filter is told a wrong
/// place, so the field is searched twice. Times are computing times of the filter's thread [ms],
/// so other programs do not count.

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "ortung/mcl/Mcl.hpp"
#include "ortung/run/Feeder.hpp"
#include "ortung/run/FieldMaps.hpp"
#include "ortung/run/OpenSource.hpp"
#include "ortung/run/Robot.hpp"

namespace ortung::bench {
namespace {

double computingMilliseconds() {
  std::timespec time{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

struct Log {
  std::filesystem::path robot;
  std::filesystem::path tables;
  std::filesystem::path record;
};

struct Mode {
  const char* name;
  bool keepsTime;
  bool hasMaps;
};

struct Times {
  std::vector<double> all = {};
  std::size_t searching = 0;  ///< updates in which the field was searched
  std::size_t right = 0;      ///< estimates within 0.5 m of the truth
  std::size_t estimates = 0;
  std::size_t samples = 0;  ///< of all estimates
};

/// Computes maps of what the robot reads, one after the other.
std::jthread mapsOf(const Robot& robot) {
  return std::jthread([&robot](const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      std::vector<const SensorData*> features;
      Weighers readings;
      {
        const SensorContainer::ReadLock lock = robot.container.read();
        for (const auto& data : robot.container.all())
          if (data->canWeigh()) features.push_back(data.get());
        readings = weighersOf(features);
      }
      if (readings.empty()) continue;
      logProbabilityMap(robot.tables.region, readings,
                        mapHeadings(robot.tables.headingStep, features),
                        [&](double) { return !stop.stop_requested(); });
    }
  });
}

/// Half a field from where the robot is, and turned round.
Pose2 elsewhere(const FieldRegion& region, const Pose2& truth) {
  const FieldGrid& grid = region.grid;
  const double x = grid.originX + 0.5 * grid.columns * grid.cell;
  const double y = grid.originY + 0.5 * grid.rows * grid.cell;
  return {x - 0.5 * (truth.x - x), y - 0.5 * (truth.y - y), wrapAngle(truth.theta + 2.0)};
}

Times run(const Log& log, const Mode& mode, double budget) {
  const auto robot = openRobot(log.robot, log.tables);
  const auto source = openSource("record:" + log.record.string(), log.robot, robot->factory);
  Feeder feeder("log", *source, robot->container);
  MclConfig config = MclConfig::read(robot->config.mcl);
  config.budgetMs = budget;
  Mcl mcl(config, robot->tables.region, makeMotion(robot->config.motion, robot->factory));
  if (mode.keepsTime) mcl.keepTime(computingMilliseconds);
  mcl.startGlobal();
  std::jthread maps = mode.hasMaps ? mapsOf(*robot) : std::jthread();
  Times times;
  bool isMoved = false;
  while (feeder.next()) {
    if (!isMoved && feeder.progress() > 0.5 && feeder.truth()) {
      mcl.setPose(elsewhere(robot->tables.region, *feeder.truth()),
                  {0.01, 0, 0, 0, 0.01, 0, 0, 0, 0.01});
      isMoved = true;
    }
    const double before = computingMilliseconds();
    const bool isTold = mcl.update(robot->container);
    times.all.push_back(computingMilliseconds() - before);
    if (mcl.isSearching()) ++times.searching;
    if (!isTold) continue;
    ++times.estimates;
    times.samples += mcl.samples().size();
    if (feeder.truth() && distance(mcl.estimate().pose, *feeder.truth()) < 0.5) ++times.right;
  }
  return times;
}

void print(const std::string& name, const Mode& mode, Times times) {
  std::sort(times.all.begin(), times.all.end());
  const auto share = [&](double part) {
    return times.all[static_cast<std::size_t>(part * static_cast<double>(times.all.size() - 1))];
  };
  const auto each = static_cast<double>(std::max<std::size_t>(1, times.estimates));
  std::printf(
      "%-16s %-16s %6zu updates, %5zu searching: p50 %6.2f  p99 %6.2f  p99.9 %6.2f  max "
      "%6.2f ms, %5.0f samples, %.3f right\n",
      name.c_str(), mode.name, times.all.size(), times.searching, share(0.5), share(0.99),
      share(0.999), share(1.0), static_cast<double>(times.samples) / each,
      static_cast<double>(times.right) / each);
  std::fflush(stdout);
}

int measureAll(int count, char** words) {
  if (count < 4) {
    std::fputs("update_times FOLDER BUDGET_MS NAME...\n", stderr);
    return 2;
  }
  const std::filesystem::path folder = words[1];
  const double budget = std::strtod(words[2], nullptr);
  for (int i = 3; i < count; ++i) {
    const std::string name = words[i];
    const Log log{folder / (name + "-robot.toml"), folder / (name + ".ortung"),
                  folder / (name + ".rec")};
    for (const Mode& mode : {Mode{"nominal", false, false}, Mode{"clock", true, false},
                             Mode{"clock and maps", true, true}})
      print(name, mode, run(log, mode, budget));
  }
  return 0;
}

}  // namespace
}  // namespace ortung::bench

int main(int count, char** words) {
  try {
    return ortung::bench::measureAll(count, words);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
