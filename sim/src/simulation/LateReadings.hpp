#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "ortung/sim/Simulation.hpp"

namespace ortung {

/// Readings that are generated when somebody asks for them. Until then the simulation remembers
/// where everything was when they were due. Not thread-safe.
class LateReadings {
 public:
  /// @param simulation borrowed, owns this
  explicit LateReadings(Simulation& simulation) : simulation_(simulation) {}

  /// Lets a robot postpone its readings until somebody asks for its container.
  void watch(SimRobot& robot);
  /// Remembers where everything is, for the readings that were postponed in this cycle.
  void remember();
  /// Tells that things are elsewhere from now on.
  void leave() { isThere_ = false; }
  /// Generates a robot's readings of the last cycle in which it sensed, if they were postponed.
  void read(std::size_t place);
  /// Generates all that was postponed, before the simulation gets other bodies.
  void readAll();

 private:
  /// Where everything was at one time.
  struct Moment {
    struct Robot {
      RobotState state;
      std::vector<std::uint32_t> motionData;  ///< what the state's is, since a drive reuses its own
      std::vector<std::size_t> manipulators;
    };
    struct Thing {
      Pose2 pose;
      Twist velocity;
    };
    Timestamp time = 0;
    std::vector<Robot> robots;
    std::vector<Thing> things;
  };

  void fill(Moment& moment) const;
  void show(const Moment& moment, bool isPresent);
  Moment& unusedMoment();
  bool isNeeded(const Moment& moment) const;
  void catchUp(SimRobot& robot);
  std::span<Message> senseAt(SimRobot& robot, Timestamp time);

  Simulation& simulation_;
  std::vector<std::unique_ptr<Moment>> moments_;
  Moment present_;
  Timestamp sensedAt_ = 0;  ///< time at which robots sensed last
  bool isThere_ = false;    ///< whether everything is still where it was then
};

}  // namespace ortung
