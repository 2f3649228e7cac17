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

class LateReadings;
class Physics;
class Workers;

/// Thrown when there is no room for a robot or thing at the pose where it should be placed.
class ORTUNG_API NoRoom : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
  ~NoRoom() override;
};

/// Simulates robots and movable things in a world in cycles of fixed length: rigid bodies that
/// collide, roll and are kicked. The same seed and the same commands give the same bits, with any
/// number of threads. Not thread-safe.
class ORTUNG_API Simulation {
 public:
  /// The settings of a simulation.
  struct Config {
    std::optional<double> cycle = std::nullopt;  ///< length of a cycle [s]; none: the world's
    std::uint64_t seed = 1;
    bool noise = true;     ///< whether sensors, odometry and slipping wheels have noise
    unsigned threads = 1;  ///< number of threads that sense
    /// Called at the end of a cycle with each failure of a robot's plugins; may be empty.
    std::function<void(const std::string&)> onProblem = {};
    /// Whether bodies move as they did in version 0.2, bit for bit, which takes longer.
    bool likeVersion02 = false;
    /// Whether sensors sense only when somebody asks for their readings, by readings() or for a
    /// robot's container. Each reading then has random numbers of its own, and is the same whether
    /// it is asked for at once, later, or after many that nobody asked for.
    bool sensesWhenRead = false;
    /// Checks the settings. @throws std::invalid_argument naming the field, its value and the range
    void check() const;
  };

  /// A movable thing that is not a robot: a ball, a crate.
  struct Thing {
    std::string name;  ///< its name in the world file
    std::string kind;
    Pose2 pose;         ///< pose in the field frame
    Twist velocity;     ///< velocity in the field frame
    double mass = 0.0;  ///< mass [kg]
  };

  /// Places the world's movable things.
  /// @throws std::invalid_argument for one that overlaps something
  Simulation(std::unique_ptr<SimWorld> world, const Config& config);
  ~Simulation();
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  /// Adds a robot. @param start pose in the field frame
  /// @throws NoRoom if the robot does not fit there; std::invalid_argument if another one has its
  ///   name or all robots together have too many pieces; ConfigError, PluginError
  SimRobot& addRobot(const RobotConfig& config, PluginFactory& factory, const Pose2& start);
  /// Removes a robot and its readings.
  void removeRobot(const SimRobot& robot);

  /// Simulates one cycle: all robots sense at now(), and everything moves until the next cycle. A
  /// caller that commands robots by this cycle's readings calls the two halves.
  void step() {
    sense();
    move();
  }
  /// Lets all robots sense at now().
  void sense();
  /// Moves everything until the next cycle.
  void move();
  /// Returns the robot with this number, which is never reused; null if it has left.
  SimRobot* find(RobotNumber robot) const;
  /// Returns the readings of a robot's sensors in the last cycle; valid until the next.
  std::span<const Message> readings(std::size_t robot) const;
  /// Returns the same by a robot's number; none if it has left.
  std::span<const Message> readingsOf(RobotNumber robot) const;
  /// Returns the readings for callers that move the words out of them.
  std::span<Message> readingsOf(RobotNumber robot);

  /// Moves a robot to another pose, unnoticed by its odometry (kidnaps it). @throws NoRoom if it
  /// does not fit there
  void place(SimRobot& robot, const Pose2& pose);

  /// Gives a robot the marker of its team, which cameras see; "": none.
  void setTeam(const SimRobot& robot, const std::string& team);

  /// Returns all movable things that are not robots.
  std::span<const Thing> things() const { return things_; }
  /// Moves a thing to a pose and gives it a velocity, both in the field frame. @throws
  /// std::invalid_argument if it does not fit there
  void placeThing(std::size_t thing, const Pose2& pose, const Twist& velocity = {});

  Timestamp now() const { return now_; }
  double cycle() const { return toSeconds(cycle_); }  ///< length of a cycle [s]
  const SimWorld& world() const { return *world_; }
  std::span<const std::unique_ptr<SimRobot>> robots() const { return robots_; }
  /// Returns a random generator by the seed, for streams that do not belong to a robot.
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

  friend class LateReadings;
  std::span<Message> newest(std::size_t robot) const;

  Config config_;
  std::unique_ptr<SimWorld> world_;
  std::shared_ptr<const FieldModel> field_;  ///< what robots know of the world in advance
  std::unique_ptr<Physics> physics_;
  std::unique_ptr<Workers> workers_;
  std::vector<std::unique_ptr<SimRobot>> robots_;
  std::vector<std::span<Message>> readings_;
  std::unique_ptr<LateReadings> late_;    ///< null: sensors sense when they are due
  std::vector<std::size_t> robotBodies_;  ///< the robots' bodies in the physics
  std::vector<Thing> things_;
  std::vector<std::size_t> thingBodies_;   ///< the things' bodies in the physics
  std::vector<RobotNumber> thingNumbers_;  ///< the things' numbers in the world
  std::vector<std::vector<Primitive>> thingPieces_;
  std::uint64_t added_ = 0;  ///< number of robots ever added: each has a random stream of its own
  Timestamp now_ = 0;
  Timestamp cycle_ = 0;
};

}  // namespace ortung
