#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "ortung/base/Export.hpp"
#include "ortung/mcl/PoseEstimate.hpp"

namespace ortung {

/// The probability of each delay of the readings' stamps, 0 to 3 s: a discrete Bayes filter.
///
/// Where the robot turns, starts or stops, odometry over one second gives a different motion for
/// each delay. The estimate after the readings shows which of them it was. Nothing else counts, so
/// on a straight path at constant speed nothing changes. Since odometry may be wrong, one second
/// counts 4 nats at most, and no delay ever becomes impossible, since the delay may change at any
/// time. Not thread-safe.
class ORTUNG_API Delays {
 public:
  static constexpr double kStep = 0.25;      ///< step between delays that are distinguished [s]
  static constexpr std::size_t kCount = 13;  ///< number of delays: zero to 3 s
  /// The predicted estimate for each delay, by odometry with that delay; field frame.
  using Predicted = std::array<PoseEstimate, kCount>;

  Delays() { forget(); }
  static double secondsOf(std::size_t delay) { return kStep * static_cast<double>(delay); }
  void forget();
  double probability(std::size_t delay) const { return probability_[delay]; }
  std::size_t mostProbable() const;
  /// Updates the probabilities by readings over a second or more.
  /// @param predicted estimates predicted from the one before these readings, without them
  /// @param inForce the delay with which the belief was moved meanwhile
  /// @param seen estimate of the belief after the readings
  /// @param seconds time between both estimates [s]
  void follow(const Predicted& predicted, std::size_t inForce, const PoseEstimate& seen,
              double seconds);
  /// Sets the probabilities after a change of the delay that was detected otherwise.
  /// @param nats log-likelihood of each delay [nats]
  void change(std::span<const double, kCount> nats);

 private:
  std::array<double, kCount> probability_;
};

}  // namespace ortung
