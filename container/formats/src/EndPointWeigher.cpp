#include "EndPointWeigher.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "CellLookup.hpp"
#include "PointSums.hpp"
#include "ortung/base/FastMath.hpp"
#include "ortung/base/Widest.hpp"

namespace ortung {
namespace {

constexpr std::size_t kBlurredPoints = 64;  ///< most points of a blurred reading

constexpr double kStepsAnOctave = 4.0;  ///< steps of noise per doubling of it

/// Finds sine and cosine of headings, and whether the sensor is in the region.
struct Placements {
  std::array<float, PlacingPoses::kBlock> sine;
  std::array<float, PlacingPoses::kBlock> cosine;
  std::array<std::int32_t, PlacingPoses::kBlock> cell;  ///< -1: outside

  ORTUNG_INLINE static void run(Placements* found, CellLookup region, const float* x,
                                const float* y, const float* theta, float mountX, float mountY,
                                std::size_t n) {
    for (std::size_t i = 0; i < n; ++i) {
      const auto [sine, cosine] = sinCos(theta[i]);
      found->sine[i] = sine;
      found->cosine[i] = cosine;
      found->cell[i] = region.index(x[i] + cosine * mountX - sine * mountY,
                                    y[i] + sine * mountX + cosine * mountY);
    }
  }
};

}  // namespace

void EndPointTables::complete(const SensorModel& model, double greatestRange) {
  maxRange = greatestRange;
  model_ = model;
  floor = static_cast<float>(model.logFloor());
  framed_ = FramedLevels(field);
  for (std::size_t c = 0; c < kRangeClasses; ++c) {
    const double range = (static_cast<double>(c) + 0.5) / kRangeClasses * maxRange;
    logByLevel_[c] = logByLevelOf(sigmaAt(range), 1.0);
  }
}

double EndPointTables::sigmaAt(double range) const {
  // Rounding to a cell adds the sigma of a uniform distribution.
  return std::hypot(model_.sigmaAt(range), 0.29 * field.grid().cell);
}

EndPointTables::LogByLevel EndPointTables::logByLevelOf(double sigma, double times) const {
  LogByLevel logs{};
  for (std::size_t level = 0; level < 255; ++level) {
    const double distance = static_cast<double>(level) * field.metresPerLevel();
    logs[level] =
        static_cast<float>(times * model_.exponent * model_.logProbability(distance / sigma));
  }
  logs[255] = static_cast<float>(times * model_.logFloor());
  return logs;
}

const float* EndPointTables::logByLevel(double range) const {
  const auto rangeClass = static_cast<std::size_t>(range / maxRange * kRangeClasses);
  return logByLevel_[std::min(rangeClass, kRangeClasses - 1)].data();
}

EndPointWeigher::EndPointWeigher(std::shared_ptr<const EndPointTables> tables, const Pose2& mount)
    : tables_(std::move(tables)),
      mount_(mount),
      floor_(tables_->floor),
      fit_(tables_->surfaces, mount, tables_->model()) {}

void EndPointWeigher::add(double range, double bearing) {
  const Pose2 end = mount_ * Pose2{range * std::cos(bearing), range * std::sin(bearing), 0};
  endX_.push_back(static_cast<float>(end.x));
  endY_.push_back(static_cast<float>(end.y));
  endLog_.push_back(tables_->logByLevel(range));
  ranges_.push_back(static_cast<float>(range));
  fit_.add(range, bearing);
}

std::shared_ptr<const BlurrableWeigher> EndPointWeigher::blurred(
    const PoseResolution& spread) const {
  const std::size_t count = endX_.size();
  const std::size_t thin = (count + kBlurredPoints - 1) / kBlurredPoints;
  const std::size_t kept = (count + thin - 1) / thin;
  const double times = static_cast<double>(count) / static_cast<double>(kept);
  auto other = std::make_shared<EndPointWeigher>(tables_, mount_);
  other->floor_ = tables_->floor * static_cast<float>(times);
  for (std::size_t k = 0; k < count; k += thin) {
    const auto range = static_cast<double>(ranges_[k]);
    const auto lever = static_cast<double>(std::hypot(endX_[k], endY_[k]));
    const double sigma = std::hypot(tables_->sigmaAt(range), spread.metres, spread.radians * lever);
    const auto step = static_cast<int>(std::lround(kStepsAnOctave * std::log2(sigma)));
    const auto [logs, isNew] = other->ownLogs_.try_emplace(step);
    if (isNew) logs->second = tables_->logByLevelOf(std::exp2(step / kStepsAnOctave), times);
    other->endX_.push_back(endX_[k]);
    other->endY_.push_back(endY_[k]);
    other->endLog_.push_back(logs->second.data());
    other->ranges_.push_back(ranges_[k]);
  }
  return other;
}

double EndPointWeigher::nominalNanoseconds() const {
  return 20.0 + 1.6 * static_cast<double>(endX_.size());
}

PoseResolution EndPointWeigher::resolution() const {
  double squared = 0.0;
  for (std::size_t k = 0; k < endX_.size(); ++k)
    squared += static_cast<double>(endX_[k] * endX_[k] + endY_[k] * endY_[k]);
  const double lever = std::sqrt(squared / static_cast<double>(endX_.size()));  // [m]
  const double cell = tables_->field.grid().cell;
  return {.metres = cell, .radians = lever > cell ? cell / lever : 1.0};
}

double EndPointWeigher::logProbabilityAt(const Pose2& pose) const {
  const Pose2 sensor = pose * mount_;
  const bool isInside = tables_->region.cellAt(sensor.x, sensor.y) >= 0;
  return isInside ? Weigher::logProbabilityAt(pose) : std::numeric_limits<double>::quiet_NaN();
}

void EndPointWeigher::weigh(const SampleView& poses, std::span<float> logProbability) const {
  const CellLookup region(tables_->region);
  const auto mountX = static_cast<float>(mount_.x);
  const auto mountY = static_cast<float>(mount_.y);
  const float outside = floor_ * static_cast<float>(endX_.size());
  PointSums sums(tables_->framed(), endX_, endY_, endLog_);
  Placements found;
  PlacingPoses inside;
  std::array<std::size_t, PlacingPoses::kBlock> sampleOf;
  for (std::size_t first = 0; first < poses.size(); first += PlacingPoses::kBlock) {
    const std::size_t n = std::min(PlacingPoses::kBlock, poses.size() - first);
    const float* x = poses.x.data() + first;
    const float* y = poses.y.data() + first;
    runWidest<Placements>(&found, region, x, y, poses.theta.data() + first, mountX, mountY, n);
    inside.size = 0;
    for (std::size_t i = 0; i < n; ++i) {
      if (found.cell[i] < 0) {
        logProbability[first + i] += outside;
        continue;
      }
      const std::size_t k = inside.size++;
      inside.x[k] = x[i];
      inside.y[k] = y[i];
      inside.sine[k] = found.sine[i];
      inside.cosine[k] = found.cosine[i];
      sampleOf[k] = first + i;
    }
    const PointSums::Sums ofInside = sums.of(inside);
    for (std::size_t k = 0; k < inside.size; ++k) logProbability[sampleOf[k]] += ofInside[k];
  }
}

}  // namespace ortung
