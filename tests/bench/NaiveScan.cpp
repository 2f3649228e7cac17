#include "NaiveScan.hpp"

#include <cmath>
#include <numbers>

#include "BenchField.hpp"
#include "ortung/formats/ScanData.hpp"

namespace ortung::bench {
namespace {

constexpr std::size_t kLevels = 256;
constexpr int kDegrees = 360;
const ScanData::Config kDefaults;  // of the sensor model

}  // namespace

NaiveScan::NaiveScan(double headingStepDegrees)
    : headings_(static_cast<int>(std::lround(kDegrees / headingStepDegrees))),
      scale_(kMaxRange, kDefaults.resolution),
      sensorModel_(kLevels * kLevels) {
  const FieldGrid& grid = fieldRegion().grid;
  const auto headings = static_cast<std::size_t>(headings_);
  expected_.resize(grid.size() * headings * kBeams);
  std::vector<std::uint8_t> turn(kDegrees);
  std::size_t place = 0;
  for (std::size_t cell = 0; cell < grid.size(); ++cell) {
    for (int degree = 0; degree < kDegrees; ++degree) {
      const double range =
          castRay(grid.centreX(cell), grid.centreY(cell), degree * kRadiansADegree);
      turn[static_cast<std::size_t>(degree)] = scale_.level(range);
    }
    for (int heading = 0; heading < headings_; ++heading) {
      for (int beam = 0; beam < kBeams; ++beam) {
        const int degree = heading * kDegrees / headings_ - 90 + beam + kDegrees;
        expected_[place++] = turn[static_cast<std::size_t>(degree % kDegrees)];
      }
    }
  }
  for (std::size_t e = 0; e < kLevels; ++e) {
    for (std::size_t m = 0; m < kLevels; ++m) {
      const double levels = static_cast<double>(e) - static_cast<double>(m);
      sensorModel_[e * kLevels + m] =
          static_cast<float>(kDefaults.model.exponent *
                             kDefaults.model.logProbability(
                                 levels / scale_.levelsPerSigma(0.0, kDefaults.model.sigma)));
    }
  }
}

void NaiveScan::setReading(std::span<const float> ranges) {
  measured_.clear();
  for (const float range : ranges) measured_.push_back(scale_.level(static_cast<double>(range)));
}

void NaiveScan::getProbability(const SampleView& samples, std::span<float> logProbability) const {
  const FieldGrid& grid = fieldRegion().grid;
  const auto headings = static_cast<std::size_t>(headings_);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const auto x = static_cast<double>(samples.x[i]);
    const auto y = static_cast<double>(samples.y[i]);
    const std::ptrdiff_t cell = grid.cellAt(x, y);
    if (cell < 0) continue;
    const double turns = static_cast<double>(samples.theta[i]) / (2 * std::numbers::pi);
    const auto heading =
        static_cast<std::size_t>(std::lround((turns - std::floor(turns)) * headings_)) % headings;
    const std::size_t first = (static_cast<std::size_t>(cell) * headings + heading) * kBeams;
    float sum = 0.0F;
    for (std::size_t beam = 0; beam < measured_.size(); ++beam) {
      sum += sensorModel_[expected_[first + beam] * kLevels + measured_[beam]];
    }
    logProbability[i] += sum;
  }
}

}  // namespace ortung::bench
