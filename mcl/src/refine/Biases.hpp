#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "News.hpp"
#include "ortung/base/Export.hpp"
#include "ortung/core/Correctable.hpp"
#include "ortung/mcl/PoseEstimate.hpp"
#include "ortung/motion/MotionModel.hpp"

namespace ortung {

/// What devices get wrong always in the same way, learned while the robot drives: a Kalman filter
/// of the pose and each device's bias together (a state augmented by biases: Friedland, IEEE Trans.
/// Automatic Control 14, 1969) goes beside the samples, from where they know the robot. With the
/// pose in it, what it can't tell apart stays open: one beacon from one place says nothing of a
/// bias. A bias that is known is taken off the readings before samples are weighed; one that is
/// nearer to none than four standard errors, or was seen from few places, is none. Not thread-safe.
class ORTUNG_API Biases {
 public:
  /// Another belief, or one that nobody knows to be the same: all is forgotten.
  void forget();
  /// By odometry. @param change in the robot's old frame
  void move(const MotionModel& motion, const Pose2& change, std::uint64_t seed,
            std::uint64_t stream);
  /// Takes known biases off what is to be weighed. Features are looked at: the container is locked,
  /// or nobody else has it.
  void correct(NewsByTime& news);
  /// Learns from readings as they came. @param estimate what samples make of them
  void follow(const std::vector<News>& news, const PoseEstimate& estimate);
  /// What is known, by "model/type".
  std::map<std::string, DeviceBias> known() const;

 private:
  static constexpr Eigen::Index kPose = 3;
  static constexpr Eigen::Index kTerms = 3;  ///< number of terms of DeviceBias, in its order
  struct Device {
    std::string name;
    int values = 0;             ///< number of values it was learned from
    bool hasDistances = false;  ///< whether there are readings of distances
    bool hasBearings = false;
    bool knowsDistances = false;  ///< whether distances are known to be biased
    bool knowsBearings = false;
  };

  struct Feature {
    std::size_t device = 0;
    double learnedAt = -1.0;  ///< value of way_ when it learned last [m]; negative: never
  };

  Feature& featureOf(const News& news);
  void begin(const PoseEstimate& estimate, const std::vector<ReadingResidual>& residuals);
  void open(std::size_t device, const std::vector<ReadingResidual>& residuals);
  bool learn(std::size_t device, const ReadingResidual& residual, const Pose2& at);
  void decide();
  DeviceBias biasOf(std::size_t device) const;
  static Eigen::Index placeOf(std::size_t device) {
    return kPose + kTerms * static_cast<Eigen::Index>(device);
  }

  std::map<const SensorData*, Feature> features_;
  double way_ = 0.0;  ///< distance travelled while running [m]; a turn of 1 rad counts as 1 m
  std::vector<Device> devices_;
  bool isRunning_ = false;
  Pose2 pose_;
  Eigen::VectorXd mean_;  ///< mean of all biases; its first three are the pose's error, always zero
  Eigen::MatrixXd covariance_;
  double misfit_ = 0.0;  ///< recent share of values that don't fit
};

}  // namespace ortung
