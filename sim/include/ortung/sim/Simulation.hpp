#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Time.hpp"
#include "ortung/sim/SimRobot.hpp"
#include "ortung/sim/SimWorld.hpp"

namespace ortung {

class Physics;
class Workers;

/// There is no room for something where it is to be put.
class ORTUNG_API NoRoom : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
  ~NoRoom() override;
};

/// Runs robots and everything movable in a world in cycles of fixed length: rigid bodies that
/// collide, roll and are kicked.
/// The same seed and the same commands give the same bits, with any number of threads.
/// Not thread-safe.
class ORTUNG_API Simulation {
 public:
  struct Config {
    std::optional<double> cycle = std::nullopt;  ///< [s]; none: the world's
    std::uint64_t seed = 1;
    bool noise = true;     ///< of sensors, odometry and slipping wheels
    unsigned threads = 1;  ///< that sense
    /// Told at the end of a cycle what went wrong in it with a robot's plugins; may be empty.
    std::function<void(const std::string&)> onProblem = {};
    /// @throws std::invalid_argument naming the field, its value and the range
    void check() const;
  };

  /// Something movable that is no robot: a ball, a crate.
  struct Thing {
    std::string name;  ///< as in the world file
    std::string kind;
    Pose2 pose;         ///< in the field frame
    Twist velocity;     ///< in the field frame
    double mass = 0.0;  ///< [kg]
  };

  /// @throws std::invalid_argument for movable things of the world that overlap something
  Simulation(std::unique_ptr<SimWorld> world, const Config& config);
  ~Simulation();
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  /// @throws NoRoom if the robot does not fit there; std::invalid_argument if another one has its
  ///   name or all robots together have too many pieces; ConfigError, PluginError
  SimRobot& addRobot(const RobotConfig& config, PluginFactory& factory, const Pose2& start);
  /// Takes a robot off the field, and all that is known of it.
  void removeRobot(const SimRobot& robot);

  /// One cycle: all robots sense at now(), and everything moves until the next cycle. Whoever
  /// commands by what is sensed in this cycle calls the two halves.
  void step() {
    sense();
    move();
  }
  /// All robots sense at now().
  void sense();
  /// Everything moves until the next cycle.
  void move();
  /// The robot with this number, which no other one ever has, or null if it has left.
  SimRobot* find(RobotNumber robot) const;
  /// What a robot's sensors gave in the last cycle; valid until the next.
  std::span<const Message> readings(std::size_t robot) const { return readings_[robot]; }
  /// The same of the robot with a number; none if it has left.
  std::span<const Message> readingsOf(RobotNumber robot) const;
  /// For who takes words away, so that nobody else gets them.
  std::span<Message> readingsOf(RobotNumber robot);

  /// Carries a robot elsewhere (kidnaps it). @throws NoRoom if it does not fit there
  void place(SimRobot& robot, const Pose2& pose);

  /// Shows cameras which team a robot is of; "": none.
  void setTeam(const SimRobot& robot, const std::string& team);

  /// Everything movable that is no robot.
  std::span<const Thing> things() const { return things_; }
  /// Puts a thing somewhere, moving as given. @throws std::invalid_argument if it does not fit
  /// there
  void placeThing(std::size_t thing, const Pose2& pose, const Twist& velocity = {});

  Timestamp now() const { return now_; }
  double cycle() const { return toSeconds(cycle_); }  ///< [s]
  const SimWorld& world() const { return *world_; }
  std::span<const std::unique_ptr<SimRobot>> robots() const { return robots_; }
  /// Random numbers of the seed for whatever is not a robot's own.
  Random random(std::uint64_t stream) const;

 private:
  void addThings();
  void kick(const SimRobot& robot, std::size_t body, const ManipulatorState& state);
  void moveManipulators();
  bool moveManipulator(std::size_t robot, std::size_t manipulator, std::size_t state);
  void moveBodies();
  void checkEntry(const RobotConfig& config, const RobotShape& shape) const;
  void tellProblems();
  bool fits(std::span<const Primitive> pieces, const Pose2& pose, std::size_t self) const;

  Config config_;
  std::unique_ptr<SimWorld> world_;
  std::shared_ptr<const FieldModel> field_;  ///< what robots know of the world beforehand
  std::unique_ptr<Physics> physics_;
  std::unique_ptr<Workers> workers_;
  std::vector<std::unique_ptr<SimRobot>> robots_;
  std::vector<std::span<Message>> readings_;
  std::vector<std::size_t> robotBodies_;  ///< of the physics, by robot
  std::vector<Thing> things_;
  std::vector<std::size_t> thingBodies_;   ///< of the physics, by thing
  std::vector<RobotNumber> thingNumbers_;  ///< of the world, by thing
  std::vector<std::vector<Primitive>> thingPieces_;
  std::uint64_t added_ = 0;  ///< robots there ever were: each has random numbers of its own
  Timestamp now_ = 0;
  Timestamp cycle_ = 0;
};

}  // namespace ortung
