#include "SmallField.hpp"

#include <map>
#include <numbers>

#include "ortung/base/Random.hpp"

namespace ortung::instructions {
namespace {

constexpr int kColumns = 40;
constexpr int kRows = 30;

FieldRegion made() {
  FieldRegion region;
  region.grid = {bench::kRobot.x - 0.5 * kColumns * bench::kCell,
                 bench::kRobot.y - 0.5 * kRows * bench::kCell, bench::kCell, kColumns, kRows};
  region.open.assign(region.grid.size(), 1);
  region.standable = region.open;
  return region;
}

}  // namespace

const FieldRegion& smallRegion() {
  static const FieldRegion region = made();
  return region;
}

std::shared_ptr<ScanData> scannerWith(ScanData::Perception perception) {
  static std::map<ScanData::Perception, std::shared_ptr<ScanData>> scanners;
  std::shared_ptr<ScanData>& scanner = scanners[perception];
  if (!scanner) scanner = bench::learnedScan(perception, 2.0, smallRegion());
  return scanner;
}

SampleSet samplesOnIt(std::size_t n) {
  const FieldGrid& grid = smallRegion().grid;
  SampleSet set;
  set.resize(n);
  Random random(1);
  for (std::size_t i = 0; i < n; ++i) {
    set.x[i] = static_cast<float>(grid.originX + random.uniform(0.0, kColumns * bench::kCell));
    set.y[i] = static_cast<float>(grid.originY + random.uniform(0.0, kRows * bench::kCell));
    set.theta[i] = static_cast<float>(random.uniform(-std::numbers::pi, std::numbers::pi));
  }
  return set;
}

}  // namespace ortung::instructions
