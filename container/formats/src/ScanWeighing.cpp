/// ScanData's perceptual model: how probable a scan is at a pose.

#include <algorithm>
#include <limits>

#include "CellLookup.hpp"
#include "FormatTools.hpp"
#include "ScanCost.hpp"
#include "ScanPrepared.hpp"
#include "ortung/base/OneSample.hpp"
#include "ortung/formats/ScanData.hpp"

namespace ortung {
namespace {

constexpr std::uint8_t kLargestCost = 250;  ///< of one beam: the outlier floor in quantized form
/// Samples whose rows are looked up and prefetched at a time.
constexpr std::size_t kSamplesABlock = 64;
constexpr std::size_t kCacheLine = 64;  ///< [bytes]

}  // namespace

void ScanData::prepare() {
  if (config_.perception == Perception::kRays) {
    prepareRays();
  } else {
    prepareEndPoints();
  }
}

/// Brings the reading to the table's directions: for each direction of the run the nearest beam.
void ScanData::prepareRays() {
  const SensorModel& model = config_.model;
  const double unit = -std::log(model.outliers) / kLargestCost;  // nats of a cost of 1
  const auto quantize = [unit](double logProbability) {
    return static_cast<std::uint8_t>(
        std::clamp(std::nearbyint(-logProbability / unit), 0.0, double{kLargestCost}));
  };
  for (std::size_t d = 0; d < kLevelDifferences; ++d) {
    prepared_->costs[d] =
        quantize(model.logProbability(static_cast<double>(d) / scale_.levelsPerSigma()));
  }
  prepared_->costs.back() = kLargestCost;
  const int run = runLength(rays_.directions());
  const std::size_t padded =
      (static_cast<std::size_t>(run) + kScanBlock - 1) / kScanBlock * kScanBlock;
  prepared_->levels.assign(padded, 0);
  prepared_->caps.assign(padded, 0);
  const int thin = config_.usedBeams > 0 ? std::max(1, run / config_.usedBeams) : 1;
  prepared_->floorCost = 0;
  for (int j = 0; j < run; j += thin) {
    const double place = j * rays_.step() / config_.angleStep;
    const auto beam = std::min<long>(std::lround(place), config_.beams - 1);
    if (std::abs(place - static_cast<double>(beam)) * config_.angleStep > 0.51 * rays_.step())
      continue;
    const float range = ranges_[static_cast<std::size_t>(beam)];
    if (std::isnan(range)) continue;
    const auto at = static_cast<std::size_t>(j);
    prepared_->levels[at] = scale_.level(static_cast<double>(range));
    prepared_->caps[at] = std::isinf(range) ? quantize(std::log(model.maxRangeMass)) : kLargestCost;
    prepared_->floorCost += prepared_->caps[at];
  }
  prepared_->nats = static_cast<float>(-unit * model.exponent);
}

void ScanData::prepareEndPoints() {
  prepared_->endPoints.start(config_.model, config_.maxRange, endPoints_);
  const int thin = config_.usedBeams > 0 ? std::max(1, config_.beams / config_.usedBeams) : 1;
  for (int i = 0; i < config_.beams; i += thin) {
    const float range = ranges_[static_cast<std::size_t>(i)];
    if (!std::isfinite(range)) continue;  // a beam that sees nothing has no end
    prepared_->endPoints.add(mount(), static_cast<double>(range),
                             config_.firstAngle + i * config_.angleStep);
  }
}

double ScanData::logProbabilityAt(const Pose2& pose) const {
  const Pose2 sensor = pose * mount();
  const bool rays = config_.perception == Perception::kRays;
  const bool expects =
      rays ? rays_.row(sensor.x, sensor.y) != nullptr : grid_.cellAt(sensor.x, sensor.y) >= 0;
  if (!expects) return std::numeric_limits<double>::quiet_NaN();
  return weighOne(pose, [this](const SampleView& one, std::span<float> out) { weigh(one, out); });
}

void ScanData::weigh(const SampleView& poses, std::span<float> logProbability) const {
  if (config_.perception == Perception::kRays) {
    weighRays(poses, logProbability);
  } else {
    weighEndPoints(poses, logProbability);
  }
}

namespace {

/// Where samples look into the ray table, a block of them at a time: without branches and calls, so
/// that the compiler vectorizes it.
struct RayPlaces {
  std::array<std::int32_t, kSamplesABlock> cell;  ///< -1: outside of the table
  std::array<std::int32_t, kSamplesABlock> direction;

  void find(const FieldGrid& grid, int directions, float firstAngle, const SensorPoses& poses,
            std::size_t n) {
    const CellLookup lookup(grid);
    const auto turn = static_cast<float>(directions);
    const auto perRadian = static_cast<float>(directions / kFullTurn);
    constexpr float kMostTurns = 1e6F;  // beyond, single precision knows no direction
    for (std::size_t i = 0; i < n; ++i) cell[i] = lookup.index(poses.x[i], poses.y[i]);
    for (std::size_t i = 0; i < n; ++i) {
      const float place = (poses.theta[i] + firstAngle) * perRadian;
      const bool usual =
          static_cast<int>(place > -kMostTurns) & static_cast<int>(place < kMostTurns);
      const float bounded = usual ? place : 0.0F;  // also for NaN
      const float turns = bounded / turn;
      const auto towardsZero = static_cast<std::int32_t>(turns);
      const std::int32_t whole =
          towardsZero - static_cast<std::int32_t>(turns < static_cast<float>(towardsZero));
      const auto nearest =
          static_cast<std::int32_t>(bounded - turn * static_cast<float>(whole) + 0.5F);
      direction[i] = nearest < directions ? nearest : 0;
    }
  }
};

}  // namespace

void ScanData::weighRays(const SampleView& poses, std::span<float> logProbability) const {
  const ScanReading reading{prepared_->levels, prepared_->caps, prepared_->costs};
  const ScanCostKernel kernel = scanCostKernel();
  const float floor = prepared_->nats * static_cast<float>(prepared_->floorCost);
  const auto run = static_cast<std::size_t>(runLength(rays_.directions()));
  const std::int32_t* rowOf = rays_.rowIndex().data();
  const std::uint8_t* levels = rays_.levels().data();
  RayPlaces places;
  // Two blocks take turns: the rows of one are on their way while the other's costs are added up.
  struct Block {
    std::array<const std::uint8_t*, kSamplesABlock> rows;
    std::array<std::uint32_t, kSamplesABlock> sampleOf;
    std::size_t size = 0;
  };
  std::array<Block, 2> blocks;
  const auto add = [&](const Block& block) {
    std::array<std::uint32_t, kSamplesABlock> costs;
    kernel(reading, {block.rows.data(), block.size}, costs.data());
    for (std::size_t k = 0; k < block.size; ++k) {
      logProbability[block.sampleOf[k]] += prepared_->nats * static_cast<float>(costs[k]);
    }
  };
  std::size_t current = 0;
  forEachPoseBlock<kSamplesABlock>(
      poses, mount(), [&](std::size_t first, const SensorPoses& sensor, std::size_t n) {
        places.find(grid_, rays_.directions(), static_cast<float>(config_.firstAngle), sensor, n);
        Block& block = blocks[current];
        block.size = 0;
        for (std::size_t k = 0; k < n; ++k) {
          const std::int32_t row = places.cell[k] < 0 ? -1 : rowOf[places.cell[k]];
          if (row < 0) {
            logProbability[first + k] += floor;
            continue;
          }
          const std::uint8_t* from = levels + static_cast<std::size_t>(row) * rays_.stride() +
                                     static_cast<std::size_t>(places.direction[k]);
          for (std::size_t line = 0; line < run; line += kCacheLine)
            __builtin_prefetch(from + line);
          __builtin_prefetch(from + run - 1);
          block.rows[block.size] = from;
          block.sampleOf[block.size++] = static_cast<std::uint32_t>(first + k);
        }
        current = 1 - current;
        add(blocks[current]);
        blocks[current].size = 0;
      });
  add(blocks[1 - current]);
}

void ScanData::weighEndPoints(const SampleView& poses, std::span<float> logProbability) const {
  prepared_->endPoints.weigh(grid_, endPoints_, mount(), poses, logProbability);
}

}  // namespace ortung
