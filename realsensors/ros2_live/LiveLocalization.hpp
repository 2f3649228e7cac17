#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "CloudBands.hpp"
#include "FloorSeeker.hpp"
#include "FloorSpeech.hpp"
#include "LikelihoodMap.hpp"
#include "LiveFloors.hpp"
#include "LiveReadings.hpp"
#include "LiveRequests.hpp"
#include "MapTransform.hpp"
#include "Participant.hpp"
#include "RelocalizationCount.hpp"
#include "ortung/run/Localization.hpp"

namespace ortung::ros2 {

/// A robot that is localized by what it says in ROS 2: reads scans, odometry and frames, and tells
/// where the odometry's frame is in the map, as Nav2's amcl does. Not thread-safe.
class LiveLocalization {
 public:
  struct Options {
    LocalizationConfig localization;  ///< robot, tables, start, seed
    std::string name = "ortung";      ///< of the localization, in diagnostics
    /// Topics of scans, each with the feature it is of, as "scan=laser/LRF/scan"; without one it is
    /// the robot's only scanner.
    std::vector<std::string> scans = {"scan"};
    /// Topics whose messages fill a feature as they are, as "sonar=front/sonar/range".
    std::vector<std::string> features = {};
    std::vector<std::string> clouds = {};  ///< topics of lidars, likewise
    CloudBands bands = {};                 ///< heights at which their points count
    std::string level = "odometry";  ///< what levels them: a topic of Imu, "odometry" or "none"
    std::string odometry = "odom";   ///< topic of nav_msgs/Odometry, or "tf"
    std::string base = "base_footprint", odom = "odom", map = "map";  ///< frames
    double transformTolerance = 1.0;  ///< how far ahead transforms are valid [s]
    bool tellsTransform = true;       ///< whether map -> odom is told
    std::filesystem::path belief;     ///< kept over runs; "": none
    double saveSeconds = 10.0;        ///< between two times at which it is kept [s]
    bool startsAnew = false;          ///< whether the start counts more than that belief
    double reportSeconds = 10.0;      ///< between two reports of what is wrong [s]
  };

  /// @param requests what others ask of it
  /// @throws like Localization, std::invalid_argument for a topic that fits no scanner
  LiveLocalization(const Options& options, LiveRequests& requests);

  /// Reads and tells by a node, whose threads use this from then on: it goes first.
  /// @throws std::runtime_error of DDS
  void listen(Participant& node);
  /// Opens the robot with other tables, for changeTables(). That takes its time, so any one thread
  /// may do it while another is in run(). @throws like Localization
  std::unique_ptr<Localization> open(const std::filesystem::path& tables) const;
  /// Goes on with what open() has made of @p tables, of another world or of this one, from where
  /// the robot is now. Nothing that is read meanwhile is lost.
  /// @param floor on which the robot is there; "": on the one of the same name
  void changeTables(std::unique_ptr<Localization> opened, const std::filesystem::path& tables,
                    const std::string& floor = "");
  /// The name of the robot's floor; "" if it is not known, or if there are none. Thread-safe.
  std::string floor() const { return floors_.name(); }

  /// Whether it tells where the robot is, which it does at first. Thread-safe.
  void setActive(bool isActive);
  /// Goes on with other settings of what it tells and keeps. They are for the thread of run().
  void change(double transformTolerance, bool tellsTransform, double saveSeconds);

  /// Runs until @p goOn, which is asked now and then, says no.
  void run(const std::function<bool()>& goOn);

 private:
  void listenForClouds(Participant& node);
  static LiveReadings::Options readingsOf(const Options& options, const SensorContainer& container,
                                          const LiveFloors& floors);
  void obey();
  void startAt(const LiveRequests::InitialPose& wanted);
  void onMoment(const LiveReadings::Moment& moment);
  void tellPose(const PoseEstimate& estimate);
  void tellFloor() {
    if (node_ != nullptr) speech_.tell(floors_.name(), *node_, isActive_);
  }
  void tellDiagnostics(const PoseEstimate* relocalized);
  void followOdometry();
  void report();
  void reportSilence();
  void sayStatus(TrackStatus status, Timestamp stamp);
  void sayRelocalization(const Pose2& inField) const;
  void saveBelief();

  Options options_;
  std::unique_ptr<Localization> localization_;
  LiveFloors floors_;
  FloorSeeker seeker_{floors_};
  const SensorId odometry_;
  LiveReadings readings_;
  MapTransform transform_;
  RelocalizationCount relocalizations_;
  LiveRequests& requests_;  ///< borrowed
  std::atomic<bool> isActive_ = true;
  std::atomic<bool> tellsTransform_;
  Participant* node_ = nullptr;  ///< borrowed
  Participant::Sender pose_, particles_, diagnostics_;
  FloorSpeech speech_;
  LikelihoodMap likelihood_;
  std::optional<Message> lastOdometry_;  ///< that the localization has
  std::uint64_t toldStatus_ = 0;         ///< sequence of the status that diagnostics had last
  std::map<std::string, std::uint64_t> reported_;
  std::map<std::string, std::uint64_t> counts_;  ///< of readings, at the last report
  std::map<std::string, bool> isSilent_;         ///< topics, by then
  bool hasToldBase_ = false, isFound_ = false;
};

}  // namespace ortung::ros2
