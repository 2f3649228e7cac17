#pragma once

#include <cstdint>
#include <map>
#include <optional>

#include "News.hpp"
#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/base/Time.hpp"
#include "ortung/core/SensorContainer.hpp"
#include "ortung/mcl/MclConfig.hpp"
#include "ortung/motion/MotionModel.hpp"

namespace ortung {

/// Takes out of a container what the filter has not seen yet: odometry for the motion model, and
/// readings that are news. A robot that stands and stares does not grow more certain with every
/// repetition; readings older than the belief are late; and a scan that comes again word for word
/// though the robot moved is that of a device that hangs. Not thread-safe.
class ORTUNG_API Intake {
 public:
  /// What is new in a container.
  struct Look {
    NewsByTime news;  ///< news by time; those of one moment are weighed together
    /// Time itself went back, to this: a clock was set, or a log begins anew.
    std::optional<Timestamp> clockSetTo;
  };

  /// @param motion borrowed; follows odometry
  Intake(const MclConfig& config, MotionModel& motion) : config_(config), motion_(motion) {}

  /// Holds the container's lock meanwhile.
  /// @param delay by which stamps of readings are late
  /// @param trustsOdometry it says whether the robot stands; else every reading is news
  Look look(const SensorContainer& container, Timestamp ofBelief, bool trustsOdometry,
            Timestamp delay = 0);
  void followOdometry(const SensorContainer& container);
  /// Notes that news were weighed. @param odometry at that time, if it is known
  void used(const std::vector<News>& news, Timestamp stamp, const std::optional<Pose2>& odometry);
  void forget();
  /// Readings that were weighed since then are news once more; odometry and clock stay.
  void countAgain(Timestamp since);

  /// Time of odometry's newest reading, if the robot has any.
  const std::optional<Timestamp>& newestOdometry() const { return newestOdometry_; }
  /// A feature whose readings repeat themselves though the robot moves; null: none.
  const SensorData* frozen() const { return frozen_; }

 private:
  /// When and where a feature was last used.
  struct Use {
    std::uint64_t sequence = 0;
    Timestamp stamp = 0;
    Pose2 odometry;
  };
  /// A reading's words, and where the robot was when they first came.
  struct Words {
    std::uint64_t sequence = 0;
    std::uint64_t hash = 0;
    std::optional<Pose2> odometry;
    bool isFrozen = false;
  };
  std::optional<Timestamp> clockSetBack(const SensorContainer& container, Timestamp ofBelief);
  void passOver(const SensorContainer& container, Timestamp stamp);
  bool isOdometry(const SensorData& data);
  void takeOdometry(const SensorContainer& container);
  bool isNews(const SensorData& data, Timestamp ofBelief, bool trustsOdometry,
              Timestamp delay) const;
  bool isFrozen(const SensorData& data);
  bool hasMoved(const Pose2& from, const Pose2& to) const;

  const MclConfig& config_;
  MotionModel& motion_;
  std::map<const SensorData*, Use> uses_;
  std::map<const SensorData*, Words> words_;
  std::map<const SensorData*, std::uint64_t> seen_;  ///< sequence numbers at the look before
  std::map<const SensorData*, bool> isOdometry_;  ///< whether a feature is odometry, by its format
  int looksBehind_ = 0;        ///< looks in a row at which all news was much older than the belief
  Timestamp behindSince_ = 0;  ///< newest stamp at the first of those looks
  std::optional<Timestamp> newestOdometry_;
  std::uint64_t odometrySequence_ = 0;  ///< sequence number of the newest odometry that motion took
  const SensorData* frozen_ = nullptr;
};

}  // namespace ortung
