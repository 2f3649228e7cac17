/// How often lrf_iconic finds a position in the scans of logs, how often it is wrong, and how long
/// it takes.
///
///     iconic_fixes [--wrong] FOLDER NAME...
///
/// For each NAME, FOLDER has NAME.rec (with ground truth), NAME-iconic.toml and NAME-iconic.ortung,
/// as scripts/evaluate-iconic.py leaves them. --wrong also prints each wrong position.

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "FoundPositions.hpp"
#include "ortung/run/Feeder.hpp"
#include "ortung/run/OpenSource.hpp"
#include "ortung/run/Robot.hpp"

namespace ortung::bench {
namespace {

double at(std::vector<double>& values, double share) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

void print(const Pose2& truth, double seconds, const PoseFixData::Reading& fixes) {
  std::printf("  %.2f s, at %.2f %.2f %.2f:", seconds, truth.x, truth.y, truth.theta);
  for (const PoseFixData::Fix& fix : fixes)
    std::printf("  %.2f %.2f %.2f (%.1f m)", fix.pose.x, fix.pose.y, fix.pose.theta,
                distance(fix.pose, truth));
  std::printf("\n");
}

void measure(const std::filesystem::path& folder, const std::string& name, bool printsWrong) {
  const auto robot =
      openRobot(folder / (name + "-iconic.toml"), folder / (name + "-iconic.ortung"));
  const auto source = openSource("record:" + (folder / (name + ".rec")).string(),
                                 folder / (name + "-iconic.toml"), robot->factory);
  const auto* position = dynamic_cast<PoseFixData*>(robot->container.find({.feature = "position"}));
  Feeder feeder(name, *source, robot->container);
  FoundPositions found;
  std::vector<double> milliseconds;  // of moments with a scan; feeding costs some hundredths
  std::uint64_t seen = 0;
  while (true) {
    const std::clock_t begin = std::clock();  // of the processor: others may use the machine
    if (!feeder.next()) break;
    const double taken = 1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    if (position->sequence() == seen) continue;
    seen = position->sequence();
    if (!feeder.truth()) continue;
    milliseconds.push_back(taken);
    if (!found.add(position->reading(), *feeder.truth()) && printsWrong)
      print(*feeder.truth(), feeder.seconds(), position->reading());
  }
  const double median = found.errors.empty() ? 0.0 : found.medianError();
  const double nees = found.errors.empty() ? 0.0 : found.nees();
  const double half = at(milliseconds, 0.5);
  std::printf("| %s | %zu | %zu | %zu | %zu | %zu | %.3f | %.1f | %.2f | %.2f | %.2f |\n",
              name.c_str(), found.scans, found.fixed(), found.wrong, found.certain,
              found.certainlyWrong, median, nees, half, at(milliseconds, 0.95),
              at(milliseconds, 1.0));
  std::fflush(stdout);
}

}  // namespace
}  // namespace ortung::bench

int main(int count, char** arguments) {
  const bool printsWrong = count > 1 && std::string(arguments[1]) == "--wrong";
  const int first = printsWrong ? 2 : 1;
  if (count < first + 2) {
    std::fprintf(stderr, "usage: %s [--wrong] FOLDER NAME...\n", arguments[0]);
    return 1;
  }
  try {
    for (int i = first + 1; i < count; ++i)
      ortung::bench::measure(arguments[first], arguments[i], printsWrong);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s: %s\n", arguments[0], e.what());
    return 1;
  }
  return 0;
}
