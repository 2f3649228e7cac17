#include "EndPointWeigher.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "CellLookup.hpp"

namespace ortung {

void EndPointTables::complete(const SensorModel& model, double greatestRange) {
  maxRange = greatestRange;
  floor = static_cast<float>(model.logFloor());
  for (std::size_t c = 0; c < kRangeClasses; ++c) {
    const double range = (static_cast<double>(c) + 0.5) / kRangeClasses * maxRange;
    // Half a cell's width is not the sensor's fault.
    const double sigma = std::hypot(model.sigmaAt(range), 0.29 * field.grid().cell);
    for (std::size_t level = 0; level < 255; ++level) {
      const double distance = static_cast<double>(level) * field.metresPerLevel();
      logByLevel_[c][level] =
          static_cast<float>(model.exponent * model.logProbability(distance / sigma));
    }
    logByLevel_[c][255] = floor;
  }
}

const float* EndPointTables::logByLevel(double range) const {
  const auto rangeClass = static_cast<std::size_t>(range / maxRange * kRangeClasses);
  return logByLevel_[std::min(rangeClass, kRangeClasses - 1)].data();
}

EndPointWeigher::EndPointWeigher(std::shared_ptr<const EndPointTables> tables, const Pose2& mount)
    : tables_(std::move(tables)), mount_(mount) {}

void EndPointWeigher::add(double range, double bearing) {
  const Pose2 end = mount_ * Pose2{range * std::cos(bearing), range * std::sin(bearing), 0};
  endX_.push_back(static_cast<float>(end.x));
  endY_.push_back(static_cast<float>(end.y));
  endLog_.push_back(tables_->logByLevel(range));
}

PoseResolution EndPointWeigher::resolution() const {
  double squared = 0.0;
  for (std::size_t k = 0; k < endX_.size(); ++k)
    squared += static_cast<double>(endX_[k] * endX_[k] + endY_[k] * endY_[k]);
  const double lever = std::sqrt(squared / static_cast<double>(endX_.size()));  // [m]
  const double cell = tables_->field.grid().cell;
  return {.metres = tables_->region.cell, .radians = lever > cell ? cell / lever : 1.0};
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
  const float floor = tables_->floor;
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
    // Even and odd points apart, and those again: additions need not wait for each other.
    float sum0 = 0.0F;
    float sum1 = 0.0F;
    float sum2 = 0.0F;
    float sum3 = 0.0F;
    for (std::size_t begin = 0; begin < count; begin += kPointsABlock) {
      const std::size_t n = std::min(kPointsABlock, count - begin);
      const float* px = endX_.data() + begin;
      const float* py = endY_.data() + begin;
      for (std::size_t k = 0; k < n; ++k) {  // vectorizes
        cells[k] =
            lookup.index(x + cosine * px[k] - sine * py[k], y + sine * px[k] + cosine * py[k]);
      }
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
