#pragma once

#include <deque>
#include <filesystem>
#include <map>
#include <memory>

#include "ortung/core/PluginFactory.hpp"
#include "ortung/server/PlainWorld.hpp"
#include "ortung/sim/SceneRun.hpp"

namespace ortung {

class Truth;

/// A simulated world for the message board, with the robots and the script of a scene if it is one;
/// a script's end is not the world's. Robots of clients start and wander as those of the source
/// `sim` do: the first robot of a server started with the same seed does the same, bit for bit.
/// Not thread-safe.
class ORTUNG_API ServedSimulation : public PlainWorld {
 public:
  /// @param file of a world or a scene
  /// @throws ConfigError, PluginError, std::invalid_argument for what SceneRun refuses
  ServedSimulation(const std::filesystem::path& file, const Simulation::Config& config,
                   const PlayerControl::Config& players = {});
  /// @throws ConfigError, PluginError, std::invalid_argument for what SceneRun refuses
  ServedSimulation(Scene scene, const Simulation::Config& config,
                   const PlayerControl::Config& players = {});
  ~ServedSimulation() override;

  WorldDescription describe() const override;
  std::vector<std::string> plugins() const override { return plugins_; }
  std::vector<std::string> players() const override { return playersHelp_; }
  std::vector<std::string> robotKinds() const override;
  Timestamp now() const override;
  /// Lets all sensors read and players act. Bodies move at the end of the cycle, which is before
  /// the next step or any other call that depends on poses.
  void step() override;
  std::vector<std::string> field() const override;
  std::vector<ServedFeature> truthFeatures() const override;
  std::span<Message> truth() override;
  std::vector<Resident> residents() const override;
  std::uint64_t residentsVersion() const override { return version_; }
  ServedRobot addRobot(RobotId robot, RobotWish wish) override;
  std::vector<std::string> abilities(RobotId robot) const override;
  void removeRobot(RobotId robot) override;
  /// Team and player of a robot, for LIST robots.
  std::string side(RobotId robot) const override;
  /// Switches features off that no client wants, so that these need not be computed.
  void want(RobotId robot, std::span<const SensorId> features) override;
  std::span<Message> readings(RobotId robot) override;
  RobotCommands& commands(RobotId robot) override;
  /// @throws ServeError for a text that exceeds the limits of talk
  void tell(RobotId robot, std::string_view text) override;
  std::vector<ServedTalk> takeHeard(RobotId robot) override;
  std::optional<std::uint64_t> seed() const override { return config_.seed; }
  void reset(std::optional<std::uint64_t> seed) override;
  void placeRobot(RobotId robot, const Pose2& pose) override;
  /// @throws ServeError if there is no such object, or no room for it
  void placeObject(const std::string& object, const Pose2& pose) override;

  /// Starts a player on a robot of its own, until the next reset. @returns the robot's name
  /// @throws ServeError, ConfigError, PluginError
  std::string startPlayer(const PlayerWish& wish);
  /// What a player says of itself; null if it says nothing. @throws PluginError
  std::unique_ptr<PlayerHelp> helpOf(const std::string& player);
  /// Gives a robot that clients have commanded back to the player that it had before.
  /// @throws ServeError if there was none, or the robot is not there
  void giveBack(RobotId robot);
  /// Ends the player on a robot. @throws ServeError if there is none
  void stopPlayer(const std::string& robot);
  /// @throws ServeError if there is no referee; std::invalid_argument for an order that is none
  void orderReferee(const std::string& order);
  /// The file of the world, or of the scene's.
  const std::filesystem::path& worldFile() const { return scene_.world; }
  /// @throws ServeError if there is no such robot
  const SimRobot& simRobot(RobotId robot) const { return find(robot); }
  /// The state of the game.
  const Game& game() const { return run_->game(); }
  /// Processor time that the thread of a cycle needs for it, as a share of the time that the cycle
  /// simulates; a mean of the newest ones. 0 before the first.
  double load() const { return load_; }
  /// What is under way; after a reset it is another one.
  SceneRun& run() { return *run_; }
  /// Something that the referee has seen or decided since the last reset.
  struct Event {
    std::uint64_t number = 0;
    RefereeEvent event;
  };
  /// The newest, at most 1000, in the order of time.
  const std::deque<Event>& events() const { return events_; }
  /// The number of the event that comes next.
  std::uint64_t eventsSoFar() const { return eventsSoFar_; }
  /// Players that control a robot at present, with their robots.
  std::vector<PlayerControl::Seated> seated() const { return run_->players().players(); }

 private:
  struct Guest;
  /// Where a building's floor is free, for field(). Made once: that takes a while.
  const std::vector<std::string>& floor() const;
  Guest& guest(RobotId robot) const;
  SimRobot& find(RobotId robot) const;
  Simulation& simulation() const { return run_->simulation(); }
  /// Moves all bodies, if sensors have read in this cycle and nothing has moved yet.
  void finishCycle();
  /// Appends the referee's new events to events_.
  void noteEvents();
  /// Adds a client's robot to the simulation. @throws ServeError if there is no room for it
  void enter(RobotId robot, Guest& guest);
  /// Takes a robot out of the simulation, if it is there.
  void takeOff(Guest& guest);
  /// Gives each object a name that is one word and unique.
  void nameObjects();
  /// Brings guests_ up to date with the scene's own robots.
  void enterResidents();
  void addResident(SimRobot& robot);
  /// Removes residents whose players have ended.
  void dropLeavers();
  /// Plans paths for robots of a size, if there is no such plan; plans cost memory, so they are
  /// few.
  void preparePlanner(const RobotSize& size, bool wanders);
  /// Frees plans that no wandering robot uses, the oldest first, until at most @p most are left.
  void dropPlanners(std::size_t most);
  bool hasWanderer(const RobotSize& size) const;

  Scene scene_;
  Simulation::Config config_;
  PlayerControl::Config playerConfig_;
  PluginFactory factory_;
  std::vector<std::string> plugins_;
  std::vector<std::string> playersHelp_;
  std::vector<ServedObject> objects_;       ///< objects in the order of the simulation's things
  mutable std::vector<std::string> floor_;  ///< of floor(); none before it is asked for
  std::unique_ptr<SceneRun> run_;
  std::unique_ptr<Truth> truth_;
  double load_ = 0.0;
  bool isMovePending_ = false;  ///< all have sensed, nothing has moved yet
  std::vector<RobotSize>
      planned_;  ///< sizes of clients' robots with a planner, the most recent last
  /// Robots by number, and so in the order in which they came.
  std::map<RobotId, std::unique_ptr<Guest>> guests_;
  RobotId lastId_ = 0;
  std::deque<Event> events_;
  std::uint64_t eventsSoFar_ = 0;
  std::uint64_t version_ = 0;  ///< counter of changes of residents()
  std::uint64_t entered_;      ///< robots since the last reset: each has chances of its own
};

}  // namespace ortung
