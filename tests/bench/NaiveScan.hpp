#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ortung/base/SampleView.hpp"
#include "ortung/tables/RangeScale.hpp"

namespace ortung::bench {

/// The paper's tables read straightforwardly: one expectation a cell, heading and beam, and a
/// sensor table over (expected, measured). Ranges in the same levels of one byte as ours.
class NaiveScan {
 public:
  explicit NaiveScan(double headingStepDegrees);
  void setReading(std::span<const float> ranges);
  /// Adds the log probability of the reading, a lookup in each table for every beam.
  void getProbability(const SampleView& samples, std::span<float> logProbability) const;
  std::size_t bytes() const { return expected_.size(); }

 private:
  int headings_;
  RangeScale scale_;
  std::vector<std::uint8_t> expected_;  ///< [y][x][heading][beam]
  std::vector<float> sensorModel_;      ///< [expected][measured]
  std::vector<std::uint8_t> measured_;
};

}  // namespace ortung::bench
