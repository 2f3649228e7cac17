#include "RayWeigher.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "CellLookup.hpp"
#include "DifferenceKernel.hpp"
#include "DirectionCorners.hpp"
#include "LevelDifference.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/base/Widest.hpp"

namespace ortung {
namespace {

/// Greatest cost of one beam: the outlier floor in quantized form.
constexpr std::uint8_t kLargestCost = 250;
/// Number of samples whose rows are looked up and prefetched at a time.
constexpr std::size_t kSamplesABlock = 64;
constexpr std::size_t kCacheLine = 64;  ///< [bytes]
/// Steps of cost are chosen from a scale of so many per octave, so that few occur in one scan.
constexpr double kStepsAnOctave = 8.0;
constexpr double kMostEntriesALevel = 3.9;  ///< most entries of the table of costs per level

double square(double value) { return value * value; }

/// Fetches so many lines of a row into the caches: few, as a rule, and the same number each time.
ORTUNG_INLINE void fetch(const std::uint8_t* row, std::size_t lines) {
  switch (lines) {
    default:
      for (; lines > 4; --lines) __builtin_prefetch(row + (lines - 1) * kCacheLine);
      [[fallthrough]];
    case 4:
      __builtin_prefetch(row + 3 * kCacheLine);
      [[fallthrough]];
    case 3:
      __builtin_prefetch(row + 2 * kCacheLine);
      [[fallthrough]];
    case 2:
      __builtin_prefetch(row + kCacheLine);
      [[fallthrough]];
    case 1:
      __builtin_prefetch(row);
  }
}

/// Computes where samples look into the ray table, a block of them at a time, without branches and
/// calls, so that the compiler vectorizes it.
struct RayPlaces {
  std::array<std::int32_t, kSamplesABlock> cell;  ///< -1: outside of the table
  std::array<std::int32_t, kSamplesABlock> direction;

  ORTUNG_INLINE static void run(RayPlaces* places, CellLookup lookup, int directions,
                                float firstAngle, SensorPoses poses, std::size_t n) {
    std::int32_t* cell = places->cell.data();
    std::int32_t* direction = places->direction.data();
    const auto turn = static_cast<float>(directions);
    const auto perRadian = static_cast<float>(directions / kTurn);
    for (std::size_t i = 0; i < n; ++i) cell[i] = lookup.index(poses.x[i], poses.y[i]);
    for (std::size_t i = 0; i < n; ++i) {
      const float within = withinTurn((poses.theta[i] + firstAngle) * perRadian, turn);
      const auto nearest = static_cast<std::int32_t>(within + 0.5F);
      direction[i] = nearest < directions ? nearest : 0;
    }
  }
};

/// What is around the poses of a block, whose rows are on their way from memory.
struct BlockAround {
  std::array<LevelsAround, kSamplesABlock> levels;
  std::array<std::uint32_t, kSamplesABlock> sampleOf;
  std::array<bool, kSamplesABlock> isLast;  ///< whether it begins with the table's last direction
  std::size_t size = 0;
};

/// Rows of a table end before the direction next to a run that begins with the last direction:
/// copies of such rows have it.
class WrappedRows {
 public:
  WrappedRows(std::size_t run, int directions)
      : run_(run), directions_(static_cast<std::size_t>(directions)) {}

  void wrap(LevelsAround& levels) {
    const std::size_t stride = run_ + 1 + LevelDifferences::kBlock;
    copies_.resize(LevelsAround::kCells * stride);
    for (std::size_t c = 0; c < LevelsAround::kCells; ++c) {
      std::uint8_t* copy = copies_.data() + c * stride;
      std::copy_n(levels.rows[c], run_, copy);
      copy[run_] = *(levels.rows[c] + run_ - directions_);
      levels.rows[c] = copy;
    }
  }

 private:
  std::size_t run_;
  std::size_t directions_;
  std::vector<std::uint8_t> copies_;
};

}  // namespace

RayWeigher::RayWeigher(std::shared_ptr<const DirectionTable> rays, const Pose2& mount,
                       double firstAngle, const SensorModel& model, std::size_t run, SurfaceFit fit,
                       const PoseResolution& spread)
    : rays_(std::move(rays)),
      mount_(mount),
      firstAngle_(static_cast<float>(firstAngle)),
      model_(model),
      spread_(spread),
      run_(run),
      unit_(-std::log(model.outliers) / kLargestCost),
      nats_(static_cast<float>(-unit_ * model.exponent)),
      farCost_(quantize(std::log(model.maxRangeMass))),
      fit_(std::move(fit)) {
  const std::size_t padded = (run + kScanBlock - 1) / kScanBlock * kScanBlock;
  levels_.assign(padded, 0);
  if (!isSpread()) parts_.assign(padded, 0);
  caps_.assign(padded, 0);
  levelsPerSigma_.assign(run, 0.0);
  beams_.reserve(run);
}

void RayWeigher::add(std::size_t at, double range, const RangeScale& scale) {
  if (isSpread())
    levels_[at] = scale.level(range);
  else
    parts_[at] = partsOf(scale, range);
  caps_[at] = std::isinf(range) ? farCost_ : kLargestCost;
  floorCost_ += caps_[at];
  const double known = std::min(range, scale.maxRange());
  const double sigma = std::sqrt(square(model_.sigmaAt(known)) + square(spread_.metres) +
                                 square(spread_.radians * known));
  const double levels = scale.levelsPerSigma(known, sigma);
  levelsPerSigma_[at] =
      isSpread() ? levels : kPartsALevel * std::sqrt(square(levels) + square(kRoundingOfLevels));
  scale_ = scale;
  beams_.push_back({at, range});
}

std::uint8_t RayWeigher::quantize(double logProbability) const {
  return static_cast<std::uint8_t>(
      std::clamp(std::nearbyint(-logProbability / unit_), 0.0, double{kLargestCost}));
}

std::shared_ptr<const BlurrableWeigher> RayWeigher::blurred(const PoseResolution& spread) const {
  auto other = std::make_shared<RayWeigher>(rays_, mount_, static_cast<double>(firstAngle_), model_,
                                            run_, fit_, spread);
  for (const Beam& beam : beams_) other->add(beam.at, beam.range, scale_);
  other->complete();
  return other;
}

double RayWeigher::nominalNanoseconds() const {
  const auto run = static_cast<double>(run_);
  return isSpread() ? 10.0 + 0.12 * run : 30.0 + 0.5 * run;
}

double RayWeigher::logProbabilityAt(const Pose2& pose) const {
  const Pose2 sensor = pose * mount_;
  const bool expects = rays_->row(sensor.x, sensor.y) != nullptr;
  return expects ? Weigher::logProbabilityAt(pose) : std::numeric_limits<double>::quiet_NaN();
}

/// One table of costs serves beams of different noise: each beam's difference of levels is scaled
/// to entries of the table by its sigma. The table is as fine as the finest levels, unless it would
/// end before only the floor is left, or the coarsest levels would span too many of its entries.
bool RayWeigher::complete() {
  if (floorCost_ == 0) return false;
  const double reach = std::sqrt(-2.0 * std::log(model_.outliers)) + 0.5;  // [sigma]
  double most = 0.0;                                                       // levels per sigma
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t at = 0; at < run_; ++at) {
    if (caps_[at] == 0) continue;
    most = std::max(most, levelsPerSigma_[at]);
    least = std::min(least, levelsPerSigma_[at]);
  }
  const double entries =
      std::min({most, (kLevelDifferences - 2) / reach, kMostEntriesALevel * least});  // per sigma
  for (std::size_t d = 0; d < kLevelDifferences; ++d)
    costs_[d] = quantize(model_.logProbability(static_cast<double>(d) / entries));
  costs_.back() = kLargestCost;
  // If noise grows as the levels do, each level is one entry.
  if (least < most || entries < most) setSteps(entries, least);
  levelsPerSigma_ = {};
  return true;
}

void RayWeigher::setSteps(double entries, double least) {
  constexpr double kLargestStep = 127.0;
  const double shift = std::floor(std::log2(kLargestStep * least / entries));
  shift_ = static_cast<int>(std::clamp(shift, 0.0, double{kMostShift}));
  steps_.assign(levels_.size(), 0);
  for (std::size_t at = 0; at < run_; ++at) {
    if (caps_[at] == 0) continue;
    const double octaves =
        std::nearbyint(std::log2(entries / levelsPerSigma_[at]) * kStepsAnOctave) / kStepsAnOctave;
    const double step = std::nearbyint(std::exp2(octaves + shift_));
    steps_[at] = static_cast<std::uint8_t>(std::clamp(step, 1.0, kLargestStep));
  }
}

void RayWeigher::weighByCells(const SampleView& poses, std::span<float> logProbability) const {
  const ScanReading reading{levels_, caps_, steps_, shift_, costs_};
  const ScanCostKernel kernel = scanCostKernel();
  const float floor = nats_ * static_cast<float>(floorCost_);
  const std::int32_t* rowOf = rays_->rowIndex().data();
  const std::uint8_t* levels = rays_->levels().data();
  RayPlaces places;
  const std::size_t lines = (run_ + kCacheLine - 1) / kCacheLine;
  const CellLookup lookup(rays_->grid());
  // Two blocks take turns: the rows of one are fetched while the other's costs are added up.
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
      logProbability[block.sampleOf[k]] += nats_ * static_cast<float>(costs[k]);
    }
  };
  std::size_t current = 0;
  forEachPoseBlock<kSamplesABlock>(
      poses, mount_, [&](std::size_t first, const SensorPoses& sensor, std::size_t n) {
        runWidest<RayPlaces>(&places, lookup, rays_->directions(), firstAngle_, sensor, n);
        Block& block = blocks[current];
        block.size = 0;
        for (std::size_t k = 0; k < n; ++k) {
          const std::int32_t row = places.cell[k] < 0 ? -1 : rowOf[places.cell[k]];
          if (row < 0) {
            logProbability[first + k] += floor;
            continue;
          }
          const std::uint8_t* from = levels + static_cast<std::size_t>(row) * rays_->stride() +
                                     static_cast<std::size_t>(places.direction[k]);
          fetch(from, lines);
          __builtin_prefetch(from + run_ - 1);
          block.rows[block.size] = from;
          block.sampleOf[block.size++] = static_cast<std::uint32_t>(first + k);
        }
        current = 1 - current;
        add(blocks[current]);
        blocks[current].size = 0;
      });
  add(blocks[1 - current]);
}

void RayWeigher::weighBetweenCells(const SampleView& poses, std::span<float> logProbability) const {
  static_assert(kSamplesABlock == DirectionCorners::kBlock);
  static_assert(kScanBlock % LevelDifferences::kBlock == 0);
  static_assert(kScanBlock <= DirectionTable::kSlack);  // what padding reads behind a row
  const ScanReading reading{levels_, caps_, steps_, shift_, costs_};
  const DifferenceKernel differ = differenceKernel();
  const ScanCostKernel kernel = scanCostKernel();
  const float floor = nats_ * static_cast<float>(floorCost_);
  const std::int32_t last = rays_->directions() - 1;
  DirectionCorners corners(*rays_, firstAngle_);
  WrappedRows wrapped(run_, rays_->directions());
  const std::size_t lines = run_ / kCacheLine + 1;
  const std::size_t padded = levels_.size();
  const std::size_t whole =
      (run_ + LevelDifferences::kBlock - 1) / LevelDifferences::kBlock * LevelDifferences::kBlock;
  std::vector<std::uint8_t> differences(kSamplesABlock * padded, 0);
  std::array<const std::uint8_t*, kSamplesABlock> rows;
  for (std::size_t k = 0; k < kSamplesABlock; ++k) rows[k] = differences.data() + k * padded;
  const auto add = [&](BlockAround& block) {
    for (std::size_t k = 0; k < block.size; ++k) {
      if (block.isLast[k]) wrapped.wrap(block.levels[k]);
      differ(block.levels[k], parts_.data(), whole, differences.data() + k * padded);
    }
    std::array<std::uint32_t, kSamplesABlock> costs;
    kernel(reading, {rows.data(), block.size}, costs.data());
    for (std::size_t k = 0; k < block.size; ++k)
      logProbability[block.sampleOf[k]] += nats_ * static_cast<float>(costs[k]);
    block.size = 0;
  };
  // Two blocks take turns here, too.
  std::array<BlockAround, 2> blocks;
  std::size_t current = 0;
  forEachPoseBlock<kSamplesABlock>(
      poses, mount_, [&](std::size_t first, const SensorPoses& sensor, std::size_t n) {
        corners.start(sensor, n);
        BlockAround& block = blocks[current];
        for (std::size_t k = 0; k < n; ++k) {
          LevelsAround& levels = block.levels[block.size];
          if (!corners.around(k, levels)) {
            logProbability[first + k] += floor;
            continue;
          }
          for (const std::uint8_t* row : levels.rows) fetch(row, lines);
          block.isLast[block.size] = corners.direction(k) == last;
          block.sampleOf[block.size++] = static_cast<std::uint32_t>(first + k);
        }
        current = 1 - current;
        add(blocks[current]);
      });
  add(blocks[1 - current]);
}

void RayWeigher::weigh(const SampleView& poses, std::span<float> logProbability) const {
  if (isSpread())
    weighByCells(poses, logProbability);
  else
    weighBetweenCells(poses, logProbability);
}

}  // namespace ortung
