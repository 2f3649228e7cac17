#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

namespace ortung::learning {

// What an observation of an agent is made of, see observationOf() in Environments.cpp. Positions
// are in the goal's frame: the origin is the middle of the keeper's goal, x leads into the field.

constexpr std::size_t kSights = 5;  ///< of the ball, the newest first
constexpr float kFar = 20.0f;       ///< [m]
constexpr float kFast = 20.0f;      ///< [m/s], [rad/s]
constexpr float kOld = 10.0f;       ///< what was never seen is so old [s]
constexpr double kTurnSpeed = 3.0;  ///< of an action of 1 [rad/s]

// Places of its numbers.
constexpr std::size_t kX = 0, kY = 1, kCos = 2, kSin = 3, kForward = 4, kLeft = 5, kTurning = 6;
constexpr std::size_t kTimeLeft = 7;
constexpr std::size_t kBall = 8;  ///< x, y, age of each sight
constexpr std::size_t kOther = kBall + 3 * kSights;
constexpr std::size_t kPlain = kOther + 3;  ///< numbers without MCL's
constexpr std::size_t kSigmaPosition = kPlain, kSigmaHeading = kPlain + 1, kTracks = kPlain + 2;
constexpr std::size_t kLocalized = kPlain + 3;  ///< numbers with MCL's

constexpr double kGoalLine = -6.0;  ///< of the keeper's goal in the field frame [m]

/// Writes numbers one behind the other, within their bounds.
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
