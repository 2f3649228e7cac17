#pragma once

#include <algorithm>
#include <cstddef>

#include "ortung/mcl/MclConfig.hpp"

namespace ortung {

/// How many samples the belief may have, so that an update keeps its time (Mcl::keepTime): what
/// the last ones had time for, and a little more. Not thread-safe.
class SampleLimit {
 public:
  /// @param config borrowed
  explicit SampleLimit(const MclConfig& config) : config_(config), most_(config.maxSamples) {}

  std::size_t most() const { return most_; }
  /// Takes the number of samples that an update had time to weigh.
  /// @param all whether those were all there were
  void weighed(std::size_t samples, bool all) {
    most_ = all ? static_cast<std::size_t>(kGrowth * static_cast<double>(most_)) + 1 : samples;
    clamp();
  }
  /// Takes that an update was over too late, although it left out all that it could.
  void late(std::size_t samples) {
    most_ = std::min(most_, static_cast<std::size_t>(kShrink * static_cast<double>(samples)));
    clamp();
  }

 private:
  static constexpr double kGrowth = 1.1;
  static constexpr double kShrink = 0.8;
  void clamp() { most_ = std::clamp(most_, config_.minSamples, config_.maxSamples); }

  const MclConfig& config_;
  std::size_t most_;
};

}  // namespace ortung
