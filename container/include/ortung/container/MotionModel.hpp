#pragma once

#include <cstdint>
#include <span>

#include "ortung/container/Abi.hpp"
#include "ortung/container/Export.hpp"
#include "ortung/container/Pose2.hpp"

namespace ortung {

/// Samples to be moved, as three arrays of equal size in the field frame ([m], [m], [rad]).
struct MovableSamples {
  std::span<float> x;
  std::span<float> y;
  std::span<float> theta;
};

/// How odometry and the true motion of the robot hang together: the motion side's twin of
/// learnProbability / getProbability, which the paper only plans (end of section 5.2).
class ORTUNG_API MotionModel {
 public:
  static constexpr const char* kInterface = "ortung.MotionModel/" ORTUNG_CONTAINER_ABI;
  virtual ~MotionModel();

  /// Draws l_t from p(l_t | a, l_{t-1}) for every sample (paper, eq. 8).
  /// @param odometryChange motion since the last call in the robot's old frame
  /// @param seed, stream, first random numbers depend on these and the sample's index alone:
  ///   sample i of the spans is sample first + i of the set
  virtual void sampleMotion(const MovableSamples& samples, const Pose2& odometryChange,
                            std::uint64_t seed, std::uint64_t stream,
                            std::uint64_t first) const = 0;

  /// Takes one pair of changes of pose over the same time, each in the robot's old frame.
  virtual void learnMotion(const Pose2& odometryChange, const Pose2& trueChange);
};

}  // namespace ortung
