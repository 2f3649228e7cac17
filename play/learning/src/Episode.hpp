#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "Agent.hpp"
#include "EpisodeRecord.hpp"
#include "Settings.hpp"
#include "ortung/benchmark/GoalJudge.hpp"
#include "ortung/learning/Batch.hpp"
#include "ortung/sim/PlayerControl.hpp"
#include "ortung/sim/Simulation.hpp"

namespace ortung::learning {

/// The data that all episodes of a batch share: the world and the robots' tables. Thread-safe.
struct Field {
  std::filesystem::path file;
  std::unique_ptr<const SimWorld> world;
  std::shared_ptr<TableStore> tables;

  /// @throws ConfigError
  Field();
};

/// The data that episodes stepped by one thread share: plugins, files and plans, which cache data.
/// Not thread-safe.
class Stand {
 public:
  struct Entrant {
    PlayerWish wish;
    RobotConfig robot;
  };
  explicit Stand(const Field& field);

  Entrant& keeperOf(const Settings& settings);
  Entrant& strikerOf(const Settings& settings);
  /// Reads all that an episode needs. @throws ConfigError, PluginError
  void check(const Settings& settings);

  const Field& field;
  PluginFactory factory;
  FloorPlans plans;

 private:
  /// Returns the entrant of a player or of an agent, which is read once.
  Entrant& entrant(const std::string& text, const char* name);
  Entrant& agent(const std::filesystem::path& robot, const char* name);

  std::map<std::string, Entrant> entrants_;
};

/// An episode from its beginning to its end: a function of settings, seed, number and actions.
class Episode {
 public:
  /// @param stand borrowed
  /// @param record file for the readings of the first agent's robot; "": they are not recorded
  /// @throws ConfigError, PluginError, std::runtime_error for players that can't play
  Episode(Stand& stand, std::shared_ptr<const Settings> settings, std::uint64_t seed,
          std::uint64_t number, const std::filesystem::path& record = {});
  ~Episode();
  Episode(const Episode&) = delete;
  Episode& operator=(const Episode&) = delete;

  /// Plays one step. @param actions shape (agents, width) @throws std::runtime_error if a player
  /// was stopped
  /// @param next the episode to be stepped next, whose memory is asked for meanwhile; null: the
  ///   caches have it
  void step(std::span<const float> actions, std::size_t width, const Episode* next = nullptr);
  /// Ends the record, if there is one. @throws std::runtime_error
  void endRecord();
  bool isOver() const { return ending_ != Ending::kNone; }
  Ending ending() const { return ending_; }
  /// Writes the observations. @param out shape (agents, observation)
  void observe(std::span<float> out);
  /// Writes the rewards of the last step. @param out shape (agents)
  void reward(std::span<double> out) const;
  /// Writes the true state. @param out one row of Batch::states()
  void state(std::span<float> out) const;
  /// Asks for its memory, so that the caches have it soon; in parts, since a core waits for few
  /// answers at a time. @param part in [0, parts)
  void prefetch(int part = 0, int parts = 1) const;

  static constexpr std::size_t kState = 12;

 private:
  void placeStriker();
  bool hasPlaced(const Pose2& striker, const Pose2& ball);
  void seat(Stand::Entrant& entrant, SimRobot& robot, bool isAgent, bool isStriker);
  void beginRecord(const std::filesystem::path& file);
  void sense();
  void findMemory();
  void checkPlayers() const;
  Random stream(std::uint64_t which) const { return Random(seed_, 4 * number_ + which); }

  Stand& stand_;
  std::shared_ptr<const Settings> settings_;
  std::uint64_t seed_;
  std::uint64_t number_;
  Simulation simulation_;
  std::string problem_;
  PlayerControl control_;
  SimRobot* keeper_ = nullptr;
  SimRobot* striker_ = nullptr;
  std::vector<Agent*> agents_;  ///< the agents, which control_ owns
  GoalJudge judge_;
  Ending ending_ = Ending::kNone;
  int steps_ = 0;
  std::unique_ptr<EpisodeRecord> record_;  ///< null: it is not recorded, or has ended
  /// Where most of its memory lies.
  std::vector<std::span<const std::byte>> memory_;
};

}  // namespace ortung::learning
