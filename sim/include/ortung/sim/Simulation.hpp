#pragma once

#include <memory>
#include <span>
#include <vector>

#include "ortung/container/Export.hpp"
#include "ortung/container/Time.hpp"
#include "ortung/sim/SimRobot.hpp"
#include "ortung/sim/SimWorld.hpp"

namespace ortung {

/// Runs robots in a world in cycles of fixed length. Motion is kinematic: a robot that would touch
/// something solid or another robot stays where it is.
/// The same seed and the same commands give the same bits. Not thread-safe.
class ORTUNG_API Simulation {
 public:
  struct Config {
    double cycle = 0.01;  ///< [s]
    std::uint64_t seed = 1;
    bool noise = true;  ///< of sensors and odometry
    /// @throws std::invalid_argument naming the field, its value and the range
    void check() const;
  };

  Simulation(std::unique_ptr<SimWorld> world, const Config& config);
  ~Simulation();
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  /// @throws std::invalid_argument if the robot does not fit there; ConfigError, PluginError
  SimRobot& addRobot(const RobotConfig& config, PluginFactory& factory, const Pose2& start);
  /// Takes a robot off the field, and all that is known of it.
  void removeRobot(const SimRobot& robot);

  /// One cycle: all robots sense at now(), are commanded, and move until the next cycle.
  void step();
  /// What a robot's sensors gave in the last cycle; valid until the next.
  std::span<const Message> readings(std::size_t robot) const { return readings_[robot]; }

  /// Carries a robot elsewhere (kidnaps it). @throws std::invalid_argument if it does not fit there
  void place(SimRobot& robot, const Pose2& pose);

  Timestamp now() const { return now_; }
  const SimWorld& world() const { return *world_; }
  std::span<const std::unique_ptr<SimRobot>> robots() const { return robots_; }
  /// Random numbers of the seed for whatever is not a robot's own.
  Random random(std::uint64_t stream) const;

 private:
  bool fits(const Pose2& pose, double radius, const SimRobot* self) const;

  Config config_;
  std::unique_ptr<SimWorld> world_;
  std::vector<std::unique_ptr<SimRobot>> robots_;
  std::vector<std::span<const Message>> readings_;
  std::uint64_t added_ = 0;  ///< robots there ever were: each has random numbers of its own
  Timestamp now_ = 0;
  Timestamp cycle_ = 0;
};

}  // namespace ortung
