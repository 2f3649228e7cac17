/// How far off a robot is that is localized by the clouds of a lidar, beside one that has a planar
/// scanner in its place: drives through a simulated office.
///
///     cloud_accuracy [SECONDS [SEEDS]]

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "CloudDrive.hpp"
#include "Files.hpp"
#include "ortung/base/Angles.hpp"

namespace ortung::testing {
namespace {

struct Case {
  const char* name;
  Lidar lidar;
  CloudUse use;
};

double middle(std::vector<double> list) {
  std::sort(list.begin(), list.end());
  return list[list.size() / 2];
}

/// Prints the median over drives of their median errors, and the worst error of all.
void print(const char* name, const std::vector<DriveErrors>& drives, double reference) {
  std::vector<double> medians;
  double worst = 0.0;
  for (const DriveErrors& one : drives) {
    medians.push_back(one.median);
    worst = std::max(worst, one.worst);
  }
  const double median = middle(medians);
  std::printf("%-46s %6.1f mm  x %.2f  worst %7.1f mm\n", name, 1000 * median,
              reference > 0.0 ? median / reference : 1.0, 1000 * worst);
  std::fflush(stdout);
}

void run(double seconds, int seeds) {
  const double lean = radians(3.0);
  const Lidar few{};
  const Lidar many{.rings = 64, .columns = 1024, .lowest = -22.5, .highest = 22.5};
  const std::vector<Case> cases{
      {"16 rings", few, {}},
      {"16 rings, motion not taken out", few, {.isMotionUsed = false}},
      {"16 rings, mounted 20 degrees nose down", few, {.mountPitch = radians(20.0)}},
      {"16 rings, +-3 degrees, levelled", few, {.tilt = lean}},
      {"16 rings, +-3 degrees, not levelled", few, {.tilt = lean, .isLevelled = false}},
      {"64 rings", many, {}},
      {"64 rings, +-3 degrees, levelled", many, {.tilt = lean}},
      {"64 rings, +-3 degrees, not levelled", many, {.tilt = lean, .isLevelled = false}}};
  const test::TemporaryFolder folder;
  std::vector<std::unique_ptr<CloudDrive>> drives;
  std::vector<DriveErrors> errors;
  for (int seed = 1; seed <= seeds; ++seed) {
    const auto own = folder / std::to_string(seed);
    std::filesystem::create_directories(own);
    drives.push_back(std::make_unique<CloudDrive>(own, seconds, seed));
    errors.push_back(drives.back()->byScanner());
  }
  std::vector<double> medians;
  for (const DriveErrors& one : errors) medians.push_back(one.median);
  print("planar scanner", errors, 0.0);
  for (const Case& one : cases) {
    errors.clear();
    for (const auto& drive : drives) errors.push_back(drive->byClouds(one.lidar, one.use));
    print(one.name, errors, middle(medians));
  }
}

}  // namespace
}  // namespace ortung::testing

int main(int argc, char** argv) {
  try {
    const double seconds = argc > 1 ? std::atof(argv[1]) : 60.0;
    const int seeds = argc > 2 ? std::atoi(argv[2]) : 5;
    if (!(seconds >= 5.0 && seconds <= 3600.0) || seeds < 1 || seeds > 1000) {
      std::fprintf(stderr, "usage: cloud_accuracy [SECONDS [SEEDS]], from 5 s on\n");
      return 2;
    }
    ortung::testing::run(seconds, seeds);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "cloud_accuracy: %s\n", error.what());
    return 1;
  }
  return 0;
}
