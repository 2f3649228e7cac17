#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

namespace ortung::learning {

// The layout of an agent's observation, see observationOf() in Environments.cpp. Positions are in
// the goal's frame: the origin is the middle of the keeper's goal, and x points into the field.

constexpr std::size_t kSights = 5;  ///< number of sights of the ball, the newest first
constexpr float kFar = 20.0f;       ///< bound of distances [m]
constexpr float kFast = 20.0f;      ///< bound of velocities [m/s], [rad/s]
constexpr float kOld = 10.0f;       ///< age of something never seen [s]
constexpr double kTurnSpeed = 3.0;  ///< turn rate of an action of 1 [rad/s]

// Indices of its numbers.
constexpr std::size_t kX = 0, kY = 1, kCos = 2, kSin = 3, kForward = 4, kLeft = 5, kTurning = 6;
constexpr std::size_t kTimeLeft = 7;
constexpr std::size_t kBall = 8;  ///< first of x, y, age of each sight
constexpr std::size_t kOther = kBall + 3 * kSights;
constexpr std::size_t kPlainSize = kOther + 3;  ///< number of values without MCL's
constexpr std::size_t kSigmaPosition = kPlainSize, kSigmaHeading = kPlainSize + 1,
                      kTracks = kPlainSize + 2;
constexpr std::size_t kLocalizedSize = kPlainSize + 3;  ///< number of values with MCL's

constexpr double kGoalLine = -6.0;  ///< x of the keeper's goal line in the field frame [m]

/// Writes consecutive numbers, clamped to their bounds.
class ObservationWriter {
 public:
  explicit ObservationWriter(std::span<float> out) : out_(out) {}
  void add(double value, float most) {
    out_[place_++] = std::clamp(static_cast<float>(value), -most, most);
  }
  std::size_t size() const { return place_; }

 private:
  std::span<float> out_;
  std::size_t place_ = 0;
};

}  // namespace ortung::learning
