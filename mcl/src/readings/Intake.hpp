#pragma once

#include <cstdint>
#include <map>
#include <optional>

#include "FrozenDevices.hpp"
#include "NewReadings.hpp"
#include "OdometrySilence.hpp"
#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/base/Time.hpp"
#include "ortung/core/SensorContainer.hpp"
#include "ortung/mcl/MclConfig.hpp"
#include "ortung/motion/MotionModel.hpp"

namespace ortung {

/// Takes out of a container what the filter has not seen yet: odometry for the motion model, and
/// new readings. Not new are readings from the same place too soon after the last one, since a
/// stationary robot must not grow more certain with every repetition; readings older than the
/// belief, which are late; and those of devices that hang and repeat themselves. Not thread-safe.
class ORTUNG_API Intake {
 public:
  /// The new readings of a container.
  struct Look {
    ReadingsByTime news;  ///< new readings by time; those of one time step are weighed together
    /// Time to which the stamps have jumped back: a clock was set, or a log began anew.
    std::optional<Timestamp> clockSetTo;
  };

  /// @param motion borrowed; it is given the odometry
  Intake(const MclConfig& config, MotionModel& motion)
      : config_(config), motion_(motion), frozen_(config, motion) {}

  /// Takes odometry and returns new readings. It holds the container's read lock meanwhile.
  /// @param ofBelief time of the newest reading that was weighed
  /// @param delay delay in force of the readings' stamps
  /// @param trustsOdometry whether odometry says that the robot is stationary; if not trusted,
  ///   every reading is new
  Look look(const SensorContainer& container, Timestamp ofBelief, bool trustsOdometry,
            Timestamp delay = 0);
  void followOdometry(const SensorContainer& container);
  /// Records that readings were weighed. @param odometry odometry's pose at that time, if it is
  /// known
  void used(const std::vector<NewReading>& news, Timestamp stamp,
            const std::optional<Pose2>& odometry);
  void forget();
  /// Makes readings that were weighed since then count as new once more; odometry and clock stay.
  void countAgain(Timestamp since);

  /// Returns the time of the newest odometry, if the robot has any.
  const std::optional<Timestamp>& newestOdometry() const { return newestOdometry_; }
  /// Returns since when odometry has been missing at @p stamp; nothing: it is not.
  std::optional<Timestamp> odometrySilentSince(Timestamp stamp) const {
    return silence_.since(stamp);
  }
  /// Returns whether odometry was silent at @p stamp for a short time, which is over.
  bool isBridged(Timestamp stamp) const { return silence_.isBridged(stamp); }
  /// Returns a feature whose readings repeat themselves though the robot moves; null: none.
  const SensorData* frozen() const { return frozen_.first(); }

 private:
  /// When and where a feature was last used.
  struct Use {
    std::uint64_t sequence = 0;
    Timestamp stamp = 0;
    Pose2 odometry;
  };
  std::optional<Timestamp> clockSetBack(const SensorContainer& container, Timestamp ofBelief);
  void passOver(const SensorContainer& container, Timestamp stamp);
  bool isOdometry(const SensorData& data);
  void takeOdometry(const SensorContainer& container);
  bool isNews(const SensorData& data, Timestamp ofBelief, bool trustsOdometry,
              Timestamp delay) const;

  const MclConfig& config_;
  MotionModel& motion_;
  std::map<const SensorData*, Use> uses_;
  std::map<const SensorData*, std::uint64_t> seen_;  ///< sequence numbers at the look before
  std::map<const SensorData*, bool> isOdometry_;  ///< whether a feature is odometry, by its format
  /// Calls of look() in a row at which all new readings were much older than the belief.
  int looksBehind_ = 0;
  Timestamp behindSince_ = 0;  ///< newest stamp at the first of those looks
  std::optional<Timestamp> newestOdometry_;
  OdometrySilence silence_;
  FrozenDevices frozen_;
  std::uint64_t odometrySequence_ = 0;  ///< sequence number of the newest odometry that motion took
};

}  // namespace ortung
