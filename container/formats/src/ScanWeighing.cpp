/// ScanData's perceptual model: how probable a scan is at a pose.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "CellLookup.hpp"
#include "EndPointWeigher.hpp"
#include "FormatTools.hpp"
#include "ScanCost.hpp"
#include "SurfaceFit.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/base/Widest.hpp"
#include "ortung/formats/ScanData.hpp"

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
    constexpr float kMostTurns = 1e6F;  // beyond it, single precision has no direction
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

/// A scan in the terms of a ray table: for each direction of the run the nearest beam.
class RayWeigher final : public BlurrableWeigher, public Polishable {
 public:
  RayWeigher(std::shared_ptr<const DirectionTable> rays, const Pose2& mount, double firstAngle,
             const SensorModel& model, std::size_t run, SurfaceFit fit,
             const PoseResolution& spread = {})
      : rays_(std::move(rays)),
        mount_(mount),
        firstAngle_(static_cast<float>(firstAngle)),
        model_(model),
        spread_(spread),
        run_(run),
        unit_(-std::log(model.outliers) / kLargestCost),
        nats_(static_cast<float>(-unit_ * model.exponent)),
        fit_(std::move(fit)) {
    const std::size_t padded = (run + kScanBlock - 1) / kScanBlock * kScanBlock;
    levels_.assign(padded, 0);
    caps_.assign(padded, 0);
    levelsPerSigma_.assign(run, 0.0);
  }

  /// Adds a beam at place @p at of the run. @param range [m]; +infinity: nothing is in sight
  void add(std::size_t at, double range, const RangeScale& scale) {
    levels_[at] = scale.level(range);
    caps_[at] = std::isinf(range) ? quantize(std::log(model_.maxRangeMass)) : kLargestCost;
    floorCost_ += caps_[at];
    const double known = std::min(range, scale.maxRange());
    const double sigma = std::hypot(model_.sigmaAt(known), spread_.metres, spread_.radians * known);
    levelsPerSigma_[at] = scale.levelsPerSigma(known, sigma);
    scale_ = scale;
    beams_.push_back({at, range});
  }

  /// Is called when all beams are added. @returns whether any of them has information
  bool complete();

  std::shared_ptr<const BlurrableWeigher> blurred(const PoseResolution& spread) const override {
    auto other = std::make_shared<RayWeigher>(rays_, mount_, static_cast<double>(firstAngle_),
                                              model_, run_, fit_, spread);
    for (const Beam& beam : beams_) other->add(beam.at, beam.range, scale_);
    other->complete();
    return other;
  }
  double nominalNanoseconds() const override { return 10.0 + 0.12 * static_cast<double>(run_); }
  Slope slopeAt(const Pose2& pose) const override { return fit_.slopeAt(pose); }

 private:
  struct Beam {
    std::size_t at;  ///< place in the run
    double range;    ///< [m]
  };
  void setSteps(double entries, double least);
  std::uint8_t quantize(double logProbability) const {
    return static_cast<std::uint8_t>(
        std::clamp(std::nearbyint(-logProbability / unit_), 0.0, double{kLargestCost}));
  }
  void weigh(const SampleView& poses, std::span<float> logProbability) const override;
  double logProbabilityAt(const Pose2& pose) const override {
    const Pose2 sensor = pose * mount_;
    const bool expects = rays_->row(sensor.x, sensor.y) != nullptr;
    return expects ? Weigher::logProbabilityAt(pose) : std::numeric_limits<double>::quiet_NaN();
  }

  PoseResolution resolution() const override {
    return {.metres = rays_->grid().cell, .radians = rays_->step()};
  }

  std::shared_ptr<const DirectionTable> rays_;
  Pose2 mount_;
  float firstAngle_;
  SensorModel model_;
  PoseResolution spread_;  ///< standard deviations of the poses
  RangeScale scale_;
  std::vector<Beam> beams_;
  std::size_t run_;  ///< directions that the scan spans
  double unit_;      ///< nats of a cost of 1
  float nats_;       ///< ln p of a cost of 1, exponent included (negative)
  /// Levels of the reading, by direction from the first beam on, padded.
  std::vector<std::uint8_t> levels_;
  std::vector<std::uint8_t> caps_;
  std::vector<std::uint8_t> steps_;  ///< none: all of 1
  int shift_ = 0;
  std::array<std::uint8_t, kLevelDifferences> costs_{};
  SurfaceFit fit_;
  std::uint32_t floorCost_ = 0;         ///< cost of a sample without expectation
  std::vector<double> levelsPerSigma_;  ///< levels per sigma, by direction; zero: no beam
};

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

void RayWeigher::weigh(const SampleView& poses, std::span<float> logProbability) const {
  const ScanReading reading{levels_, caps_, steps_, shift_, costs_};
  const ScanCostKernel kernel = scanCostKernel();
  const float floor = nats_ * static_cast<float>(floorCost_);
  const std::int32_t* rowOf = rays_->rowIndex().data();
  const std::uint8_t* levels = rays_->levels().data();
  RayPlaces places;
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
          for (std::size_t line = 0; line < run_; line += kCacheLine)
            __builtin_prefetch(from + line);
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

}  // namespace

std::shared_ptr<const Weigher> ScanData::makeWeigher() const {
  return config_.perception == Perception::kRays ? makeRayWeigher() : makeEndPointWeigher();
}

std::shared_ptr<const Weigher> ScanData::makeRayWeigher() const {
  const int run = runLength(rays_->directions());
  SurfaceFit fit(surfaces_, mount(), config_.model);
  for (int i = 0; i < config_.beams; ++i) {
    const float range = ranges_[static_cast<std::size_t>(i)];
    if (std::isfinite(range))
      fit.add(static_cast<double>(range), config_.firstAngle + i * config_.angleStep);
  }
  auto weigher = std::make_shared<RayWeigher>(rays_, mount(), config_.firstAngle, config_.model,
                                              static_cast<std::size_t>(run), std::move(fit));
  const int thin = config_.usedBeams > 0 ? std::max(1, run / config_.usedBeams) : 1;
  for (int j = 0; j < run; j += thin) {
    const double place = j * rays_->step() / config_.angleStep;
    const auto beam = std::min<long>(std::lround(place), config_.beams - 1);
    if (std::abs(place - static_cast<double>(beam)) * config_.angleStep > 0.51 * rays_->step())
      continue;
    const float range = ranges_[static_cast<std::size_t>(beam)];
    if (!std::isnan(range))
      weigher->add(static_cast<std::size_t>(j), static_cast<double>(range), scale_);
  }
  return weigher->complete() ? weigher : nullptr;
}

std::shared_ptr<const Weigher> ScanData::makeEndPointWeigher() const {
  auto weigher = std::make_shared<EndPointWeigher>(endPoints_, mount());
  const int thin = config_.usedBeams > 0 ? std::max(1, config_.beams / config_.usedBeams) : 1;
  for (int i = 0; i < config_.beams; i += thin) {
    const float range = ranges_[static_cast<std::size_t>(i)];
    if (!std::isfinite(range)) continue;  // a beam without a hit has no end
    weigher->add(static_cast<double>(range), config_.firstAngle + i * config_.angleStep);
  }
  return weigher->isEmpty() ? nullptr : weigher;
}

}  // namespace ortung
