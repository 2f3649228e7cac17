#pragma once

#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "CloudBands.hpp"
#include "FrameTree.hpp"
#include "Participant.hpp"
#include "ortung/ros2/Messages.hpp"

namespace ortung::ros2 {

/// What a robot and its surroundings are, as they say in ROS 2: the map, and scanners with their
/// mounts. It listens as long as it lives. Thread-safe.
class LiveSetup {
 public:
  struct Options {
    std::vector<std::string> scans;   ///< topics
    std::vector<std::string> clouds;  ///< topics of lidars
    CloudBands bands;                 ///< what is taken of their clouds
    std::string base = "base_footprint";
    std::string map = "map";  ///< topic of the map; "": none is waited for
    double maxRange = 0.0;    ///< scans are cut there [m]; 0: where they say
  };
  LiveSetup(Options options, Participant& node);

  /// Waits for a map that was not written yet. @param goOn asked now and then
  /// @return whether there is one
  bool waitForMap(const std::function<bool()>& goOn);
  /// Waits for a scan of each scanner and a cloud of each lidar, and for the transforms that tell
  /// where these are on the robot: without them the robot would be somewhere else than it seems.
  bool waitForScanners(const std::function<bool()>& goOn);
  /// What is waited for, in words; "" if all is there.
  std::string missing() const;
  /// Whether a map has come that was not written yet.
  bool hasNewMap() const;

  /// Writes the newest map as a world. @throws std::runtime_error
  void writeWorld(const std::filesystem::path& file);
  /// Writes a robot file with the scanners and lidars, whose features are the topics' names.
  /// @param more tables of the file, as TOML @throws std::runtime_error
  void writeRobot(const std::filesystem::path& file, const std::string& more = "") const;
  /// Name of the feature that writeRobot() gives to a topic of scans or clouds, e.g.
  /// "scan/LRF/scan".
  static std::string featureOf(const std::string& topic);

  /// What was wrong with messages, since it was asked last.
  std::vector<std::string> complaints();

 private:
  void takeMap(std::string_view cdr);
  void takeScan(std::size_t scanner, std::string_view cdr);
  void takeCloud(std::size_t lidar, std::string_view cdr);
  std::string cloudsToml() const;
  void takeFrames(std::string_view cdr);
  bool knowsScanners() const;
  bool knowsMounts() const { return framesWithoutMount().empty(); }
  std::vector<std::string> framesWithoutMount() const;
  bool wait(const std::function<bool()>& goOn, const std::function<bool()>& isThere);
  void complain(const std::string& what);

  const Options options_;
  const Participant& node_;
  mutable std::mutex mutex_;
  std::condition_variable arrived_;
  std::optional<OccupancyGrid> newMap_;
  std::size_t mapDigest_ = 0;  ///< digest of the newest map's bytes
  std::vector<std::optional<LaserScan>> scans_;
  std::vector<std::optional<std::string>> cloudFrames_;  ///< frame of each lidar
  FrameTree frames_;
  std::vector<std::string> complaints_;
};

}  // namespace ortung::ros2
