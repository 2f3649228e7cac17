#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "ortung/base/Export.hpp"
#include "ortung/mcl/PoseEstimate.hpp"

namespace ortung {

/// How probable each delay of the readings' stamps is, 0 to 3 s: a Bayes filter over them.
///
/// From one second to the next odometry tells another motion for each delay where the robot turns,
/// starts or stops. The place where readings have put the robot says which of them it was. Nothing
/// else counts, so on a straight way at constant speed nothing changes. Whatever odometry gets
/// wrong, one second counts 4 nats at most, and no delay is ever impossible, since it may begin at
/// any time. Not thread-safe.
class ORTUNG_API Delays {
 public:
  static constexpr double kStep = 0.25;      ///< step between delays that are distinguished [s]
  static constexpr std::size_t kCount = 13;  ///< number of delays: zero to 3 s
  /// Where the robot is, field frame, if it moved as odometry tells for each delay.
  using Predicted = std::array<PoseEstimate, kCount>;

  Delays() { forget(); }
  static double secondsOf(std::size_t delay) { return kStep * static_cast<double>(delay); }
  void forget();
  double probability(std::size_t delay) const { return probability_[delay]; }
  std::size_t mostProbable() const;
  /// Takes what a second or more of readings have told.
  /// @param predicted from where the robot was before them, without them
  /// @param inForce the delay by whose motion the belief was moved meanwhile
  /// @param seen the belief after them
  /// @param seconds meanwhile
  void follow(const Predicted& predicted, std::size_t inForce, const PoseEstimate& seen,
              double seconds);
  /// Another delay has begun, as something else has shown. @param nats for each
  void change(std::span<const double, kCount> nats);

 private:
  std::array<double, kCount> probability_;
};

}  // namespace ortung
