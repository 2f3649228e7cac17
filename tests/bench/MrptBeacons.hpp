#pragma once

#include <memory>
#include <span>
#include <utility>

#include "ortung/base/SampleView.hpp"

namespace ortung::bench {

/// MRPT's map of beacons, of which ranges are read: one distance each. (MRPT's maps of landmarks
/// with bearings are made for pictures.)
class MrptBeacons {
 public:
  /// @param places of beacons [m], read from kRobot
  /// @param sigma standard deviation of ranges [m]
  MrptBeacons(std::span<const std::pair<double, double>> places, double sigma);
  ~MrptBeacons();
  /// Adds the log likelihood of the reading, as MRPT's particle filter asks for it.
  void getProbability(const SampleView& samples, std::span<float> logProbability) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ortung::bench
