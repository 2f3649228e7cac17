#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "AmclParameters.hpp"
#include "Bond.hpp"
#include "LearnedMaps.hpp"
#include "Lifecycle.hpp"
#include "LiveLocalization.hpp"
#include "LiveMaps.hpp"
#include "LiveRequests.hpp"
#include "LiveSetup.hpp"
#include "ParameterServices.hpp"
#include "Participant.hpp"

namespace ortung::ros2 {

/// A node of ROS 2 in amcl's place: learns the map that is told, or a world of its own whose maps
/// it tells, localizes, and is led by a lifecycle manager if there is one. Not thread-safe.
class LiveNode {
 public:
  struct Options {
    LiveLocalization::Options localization;  ///< without tables these are learned of the map
    Participant::Options node;
    AmclParameters parameters;
    std::string map = "map";       ///< topic of the map
    std::filesystem::path world;   ///< world file in place of the map of that topic; "": none
    std::string building;          ///< text of a world file, likewise; "": none
    std::filesystem::path folder;  ///< folder for what is made of the map
  };

  /// @param options its settings, where they are amcl's, stand in all parts of it
  /// @throws std::runtime_error of DDS
  explicit LiveNode(Options options);

  /// Runs until @p isStopped says so. @throws like LiveLocalization
  void run(const std::function<bool()>& isStopped);

 private:
  /// What was learned of another map, while the robot drives on.
  struct Learned {
    std::filesystem::path tables;
    std::unique_ptr<Localization> opened;
    double seconds = 0.0;  ///< that it took
  };

  void onTransition(Lifecycle::Transition transition, Lifecycle::State state);
  void openWorld();
  void listenForMap();
  void tellMap();
  std::uint64_t keyOf(const std::filesystem::path& world) const;
  std::optional<std::filesystem::path> learn();
  std::optional<Learned> learnAnother();
  void use(Learned learned);
  bool goOnWaiting();
  void localize();
  bool hasNewMap() const;
  bool hasChangedSettings() const;
  void applySettings();
  void writeRobot();

  Options options_;
  const bool makesRobot_;     ///< whether the robot file is made of messages
  AmclSettings settings_;     ///< in force
  mutable std::mutex mutex_;  ///< guards wanted_
  std::optional<AmclSettings> wanted_;
  std::function<bool()> isStopped_;
  std::chrono::steady_clock::time_point told_ = std::chrono::steady_clock::now();
  std::size_t learned_ = 0;  ///< number of maps

  // The node goes first, since its threads use the others.
  LiveRequests requests_;
  LearnedMaps tables_;
  std::optional<LiveMaps> maps_;          ///< null without maps of its own
  std::optional<LiveMaps::Wanted> next_;  ///< world that is learned
  std::atomic<bool> isActive_;
  Bond bond_;
  std::optional<Lifecycle> lifecycle_;
  std::optional<ParameterServices> services_;
  std::optional<LiveSetup> setup_;
  std::mutex localizationMutex_;  ///< for whether there is one
  std::unique_ptr<LiveLocalization> localization_;
  Participant node_;
};

}  // namespace ortung::ros2
