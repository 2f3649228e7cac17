#include "EndPointWeigher.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "CellLookup.hpp"
#include "ortung/base/Widest.hpp"

namespace ortung {
namespace {

constexpr std::size_t kBlurredPoints = 64;  ///< most points of a blurred reading

constexpr double kStepsAnOctave = 4.0;  ///< steps of noise per doubling of it

/// Finds the cells of points in the frame of a robot at (x, y).
struct EndCells {
  ORTUNG_INLINE static void run(CellLookup lookup, float x, float y, float sine, float cosine,
                                const float* px, const float* py, std::size_t n,
                                std::int32_t* cells) {
    for (std::size_t k = 0; k < n; ++k)
      cells[k] = lookup.index(x + cosine * px[k] - sine * py[k], y + sine * px[k] + cosine * py[k]);
  }
};

}  // namespace

void EndPointTables::complete(const SensorModel& model, double greatestRange) {
  maxRange = greatestRange;
  model_ = model;
  floor = static_cast<float>(model.logFloor());
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
  const EndPointField& field = tables_->field;
  const CellLookup inRegion(tables_->region);
  const CellLookup lookup(field.grid());
  const std::uint8_t* levels = field.levels().data();
  const std::size_t count = endX_.size();
  const float floor = floor_;
  const auto mountX = static_cast<float>(mount_.x);
  const auto mountY = static_cast<float>(mount_.y);
  constexpr std::size_t kPointsABlock = 64;
  std::array<std::int32_t, kPointsABlock> cells;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const float x = poses.x[i];
    const float y = poses.y[i];
    const auto [sine, cosine] = sinCos(poses.theta[i]);
    if (inRegion.index(x + cosine * mountX - sine * mountY, y + sine * mountX + cosine * mountY) <
        0) {
      logProbability[i] += floor * static_cast<float>(count);
      continue;
    }
    // Four sums, so that additions need not wait for each other.
    float sum0 = 0.0F;
    float sum1 = 0.0F;
    float sum2 = 0.0F;
    float sum3 = 0.0F;
    for (std::size_t begin = 0; begin < count; begin += kPointsABlock) {
      const std::size_t n = std::min(kPointsABlock, count - begin);
      const float* px = endX_.data() + begin;
      const float* py = endY_.data() + begin;
      runWidest<EndCells>(lookup, x, y, sine, cosine, px, py, n, cells.data());
      const float* const* logByLevel = endLog_.data() + begin;
      const auto at = [&](std::size_t k) {
        return cells[k] < 0 ? floor : logByLevel[k][levels[cells[k]]];
      };
      std::size_t k = 0;
      for (; k + 4 <= n; k += 4) {
        sum0 += at(k);
        sum1 += at(k + 1);
        sum2 += at(k + 2);
        sum3 += at(k + 3);
      }
      for (; k < n; ++k) sum0 += at(k);
    }
    logProbability[i] += (sum0 + sum1) + (sum2 + sum3);
  }
}

}  // namespace ortung
