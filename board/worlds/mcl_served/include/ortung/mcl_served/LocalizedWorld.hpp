#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/mcl_served/FilterThread.hpp"
#include "ortung/mcl_served/LocalizedRobots.hpp"
#include "ortung/server/ForwardedWorld.hpp"

namespace ortung {

/// A served world, with the features of LOCALIZATION for each robot of its own that has features to
/// localize by: while its filter is on, their readings come with the robot's. Filters run on
/// threads of their own, so when their readings come depends on the computer. One thread owns it,
/// but for what says that it is thread-safe.
class ORTUNG_API LocalizedWorld final : public ForwardedWorld, public LocalizedRobots {
 public:
  struct Config {
    /// The file of a robot of the world's own; "" if it has no features to localize by.
    std::function<std::filesystem::path(RobotId)> robotFile;
    TableGiver tables;
    std::vector<std::string> names;  ///< robots that are localized from the beginning; "all"
    std::uint64_t seed = 1;
  };

  /// @param world borrowed
  /// @throws std::invalid_argument for a name that no robot of the world's own has, or of one that
  ///   can't localize
  LocalizedWorld(ServedWorld& world, Config config);
  ~LocalizedWorld() override;

  // LocalizedRobots and PerceivingRobots
  std::optional<RobotId> usual() const override;
  bool isForAll() const override { return false; }
  LocalizationState state(RobotId robot) override;
  void order(RobotId robot, const LocalizationOrder& order) override;
  std::shared_ptr<const Robot> perceiver(RobotId robot) const override;

  // ServedWorld: what filters add
  /// One cycle of the world; afterwards filters are created for robots that came and end for
  /// others.
  void step() override;
  /// The world's own robots, with the features of LOCALIZATION in addition.
  std::vector<Resident> residents() const override;
  void want(RobotId robot, std::span<const SensorId> features) override;
  /// Readings of the world, which its filter takes, and behind them new ones of the filter.
  std::span<Message> readings(RobotId robot) override;
  std::vector<Message> lateReadings(RobotId robot) override;
  /// Time jumps: filters restart with the tables that they have.
  void seek(Timestamp stamp) override;
  void reset(std::optional<std::uint64_t> seed) override;

 private:
  /// The filter of one robot.
  struct Filter {
    std::unique_ptr<FilterThread> thread;  ///< null: it was never on
    std::vector<SensorId> wanted;          ///< features that clients ask for
    std::vector<SensorId> needs;           ///< the filter's features, as reported to the world
  };
  /// Creates filters for robots that came, and ends those of robots that left.
  void meetResidents();
  /// Restarts all filters after a jump of time, with the tables that they have.
  void restartFilters();
  /// Checks Config::names. @throws std::invalid_argument
  void checkNames() const;
  bool isNamed(const std::string& name) const;
  /// Asks the world for the features that clients or the filter need.
  void tellWanted(RobotId robot, const Filter& filter);
  /// @throws ServeError if there is no such robot, or it has no features to localize by
  Filter& filter(RobotId robot);
  /// Returns the thread of a filter, and creates it if there is none.
  FilterThread& threadOf(RobotId robot, Filter& filter);

  Config config_;
  std::vector<ServedFeature> features_;  ///< features that each filter adds
  std::optional<std::uint64_t> version_;
  mutable std::mutex mutex_;  ///< guards filters_ for members that are thread-safe
  std::map<RobotId, Filter> filters_;
  std::vector<std::unique_ptr<FilterThread>> leaving_;  ///< threads of removed robots, not over yet
  std::vector<Message> frame_;
};

}  // namespace ortung
