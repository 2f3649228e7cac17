#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "ortung/base/Export.hpp"
#include "ortung/base/Parameters.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/base/Time.hpp"
#include "ortung/container/Abi.hpp"
#include "ortung/motion/OdometryTrack.hpp"

namespace ortung {

/// Samples that are to be moved, as three arrays of equal size in the field frame ([m], [m],
/// [rad]).
struct MovableSamples {
  std::span<float> x;
  std::span<float> y;
  std::span<float> theta;
};

/// What a motion model sees of one odometry reading.
struct OdometryView {
  Pose2 pose;                                 ///< pose in the odometry frame
  double translationalVelocity = 0.0;         ///< velocity forwards [m/s]
  double rotationalVelocity = 0.0;            ///< turn rate, counter-clockwise [rad/s]
  std::span<const std::uint32_t> motionData;  ///< words of the drive's own, see OdometryData
  double lateralVelocity = 0.0;               ///< velocity to the left [m/s]
};

/// The relation between odometry and the true motion of the robot: the counterpart for motion of
/// learnProbability / getProbability, which the paper only plans (end of section 5.2).
/// Not thread-safe, but sampleMotion() may be called by several threads at once.
class ORTUNG_API MotionModel {
 public:
  static constexpr const char* kInterface = "ortung.MotionModel/" ORTUNG_CONTAINER_ABI;
  MotionModel();
  virtual ~MotionModel();

  // --- odometry ---
  /// Takes odometry's newest reading.
  virtual void follow(Timestamp stamp, const OdometryView& reading);
  /// Returns the pose in the odometry frame that belongs to the robot's true pose at @p stamp, or
  /// nothing before the first reading. By default it is odometry's own pose, delay() earlier.
  virtual std::optional<Pose2> odometryAt(Timestamp stamp) const;
  /// Forgets what follow() took.
  virtual void forget();
  /// Returns by how much the robot moves later than odometry says [s], e.g. since odometry is made
  /// of commands.
  double delay() const { return delay_; }

  // --- sampling ---
  /// Draws l_t from p(l_t | a, l_{t-1}) for every sample (paper, eq. 8).
  /// @param odometryChange motion since the last call in the robot's old frame
  /// @param seed, stream, first random numbers depend on these and the sample's index alone:
  ///   sample i of the spans is sample first + i of the set
  virtual void sampleMotion(const MovableSamples& samples, const Pose2& odometryChange,
                            std::uint64_t seed, std::uint64_t stream,
                            std::uint64_t first) const = 0;

  // --- learning ---
  /// Takes one pair of changes of pose over the same time, each in the robot's old frame. Pairs
  /// follow each other without a gap until endDrive(), so that errors over longer distances show,
  /// too.
  virtual void learnMotion(const Pose2& odometryChange, const Pose2& trueChange);
  /// Ends a drive: the next pair does not follow the last one.
  virtual void endDrive();
  /// Fits the model to all pairs; returns the mean ln p of a pair, by which models compare.
  /// @throws std::runtime_error if the pairs are too few, or the model can't learn
  virtual double endLearning();
  /// Returns the model's settings as the table [motion] of a robot file.
  virtual Parameters settings() const;

 protected:
  void setDelay(double seconds) { delay_ = seconds; }  ///< @pre finite

 private:
  OdometryTrack track_;
  double delay_ = 0.0;
};

}  // namespace ortung
