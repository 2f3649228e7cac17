#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "CarriedOn.hpp"
#include "NewReadings.hpp"
#include "ortung/base/Export.hpp"
#include "ortung/core/Correctable.hpp"
#include "ortung/mcl/PoseEstimate.hpp"
#include "ortung/motion/MotionModel.hpp"

namespace ortung {

/// Learns the systematic errors (biases) of devices while the robot drives. An extended Kalman
/// filter of the pose and all biases together (a state augmented by biases: Friedland, IEEE Trans.
/// Automatic Control 14, 1969) runs beside the samples, starting from their estimate. Since the
/// pose is part of its state, what cannot be observed stays uncertain: one beacon from one place
/// says nothing about a bias. A known bias is subtracted from the readings before they weigh
/// samples. A bias that is less than four standard errors from zero, or was learned from few
/// values, is not applied. A bias belongs to the device: it outlives the place, unless readings fit
/// no place with it. Not thread-safe.
class ORTUNG_API Biases {
 public:
  /// Forgets all biases, as devices may be other ones.
  void forget();
  /// Forgets the pose alone, as something else than odometry has moved the belief.
  void forgetPlace();
  void move(const MotionChange& change);  ///< moves the pose by odometry
  /// Corrects new readings by the known biases. It reads features, so the caller holds the
  /// container's lock, or no other thread uses the container.
  void correct(ReadingsByTime& news);
  /// Learns from readings without correction. @param estimate estimate of the samples after they
  /// were weighed
  void follow(const std::vector<NewReading>& news, const PoseEstimate& estimate);
  /// Returns the known biases, by "model/type".
  std::map<std::string, DeviceBias> known() const;

 private:
  static constexpr Eigen::Index kPose = 3;
  static constexpr Eigen::Index kTerms = 3;  ///< number of terms of DeviceBias, in its order
  struct Device {
    std::string name;
    int values = 0;             ///< number of values that the bias was learned from
    bool hasDistances = false;  ///< whether there are readings of distances
    bool hasBearings = false;
    bool knowsDistances = false;  ///< whether distances are known to be biased
    bool knowsBearings = false;
  };

  struct Feature {
    std::size_t device = 0;
    double learnedAt = -1.0;  ///< value of travelled_ when it learned last [m]; negative: never
  };

  Feature& featureOf(const NewReading& news);
  void begin(const PoseEstimate& estimate, const std::vector<ReadingResidual>& residuals);
  void open(std::size_t device, const std::vector<ReadingResidual>& residuals);
  bool learn(std::size_t device, const ReadingResidual& residual, const Pose2& at);
  void decide();
  DeviceBias biasOf(std::size_t device) const;
  static Eigen::Index placeOf(std::size_t device) {
    return kPose + kTerms * static_cast<Eigen::Index>(device);
  }

  std::map<const SensorData*, Feature> features_;
  double travelled_ = 0.0;  ///< distance travelled since begin() [m]; a turn of 1 rad counts as 1 m
  std::vector<Device> devices_;
  bool isRunning_ = false;
  int fits_ = 0;   ///< values that fitted since begin()
  int waits_ = 0;  ///< values that were read since the place was forgotten
  Pose2 pose_;
  /// Mean of all biases; its first three are the pose's error, always zero.
  Eigen::VectorXd mean_ = Eigen::VectorXd::Zero(kPose);
  Eigen::MatrixXd covariance_ = Eigen::MatrixXd::Zero(kPose, kPose);
  double misfit_ = 0.0;  ///< short-term share of outliers
};

}  // namespace ortung
