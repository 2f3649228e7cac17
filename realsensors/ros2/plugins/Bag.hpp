#pragma once

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "BagFile.hpp"
#include "CloudBands.hpp"
#include "CloudShape.hpp"
#include "FrameTree.hpp"
#include "ScanShape.hpp"
#include "TiltHistory.hpp"
#include "VelocityHistory.hpp"
#include "ortung/base/Parameters.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/base/Time.hpp"
#include "ortung/core/SensorData.hpp"
#include "ortung/ros2/Messages.hpp"

namespace ortung::ros2 {

/// Options that choose what is read from a bag.
struct BagChoice {
  std::optional<std::vector<std::string>> scans, ranges, images;  ///< topics; nothing: all
  std::string odometry;      ///< topic of odometry, or "tf"; "": the first one, or else tf
  std::string truth;         ///< topic of ground truth, "tf" or "none"; "": one that is named so
  std::string map;           ///< topic of the map; "": the first one
  std::string base;          ///< frame of the robot; "": the odometry's
  bool usesLogTime = false;  ///< whether stamps are times of recording
  std::optional<std::vector<std::string>> clouds;  ///< topics; nothing: all, if there are no scans
  CloudBands bands;                                ///< what is taken of them
  std::string level = "odometry";  ///< what levels them: a topic of Imu, "odometry" or "none"
  std::map<std::string, Eigen::Isometry3d> mounts;  ///< poses of frames in that of the robot
  static BagChoice read(const Parameters& options);
};

/// A robot's messages in a bag of ROS 2 (MCAP, .db3) or ROS 1 (.bag): one file, or the folder of a
/// bag with its files. Not thread-safe.
class Bag {
 public:
  struct Scan {
    Timestamp stamp;
    std::vector<float> ranges;
  };
  struct Scans {
    std::string topic, feature;  ///< topic, and the feature by files that Ortung wrote, or ""
    std::optional<ScanShape> shape;
    std::vector<Scan> list;
    std::size_t others = 0;  ///< number of scans that did not fit, and were left out
  };
  struct Clouds {
    std::string topic, feature;
    std::optional<CloudShape> shape;  ///< nothing: it is not known where the lidar sits
    std::vector<Scan> list;
  };
  struct Reading {
    Timestamp stamp;
    double range;  ///< by REP 117 [m]
  };
  struct Ranges {
    std::string topic, feature, frame;
    double openingAngle = 0.0, maxRange = 0.0;  ///< cone's angle and length [rad, m]
    std::vector<Reading> list;
  };
  struct Moving {
    Timestamp stamp;
    Pose2 pose;
    double forward = 0.0, left = 0.0, turn = 0.0;  ///< velocities [m/s, m/s, rad/s]
  };
  struct Track {
    std::string topic, feature;
    std::vector<Moving> list;
    TiltHistory tilts = TiltHistory();  ///< of odometry
  };
  struct Picture {
    Timestamp stamp;
    std::vector<std::uint32_t> words;
  };
  struct Pictures {
    std::string topic, feature, frame;
    std::vector<Picture> list;
  };
  struct OwnWords {
    std::string feature;
    std::vector<Picture> list;
  };

  /// @throws std::runtime_error
  Bag(const std::filesystem::path& path, const BagChoice& choice);

  std::vector<Scans> scans;
  std::vector<Clouds> clouds;
  std::vector<Ranges> ranges;
  std::vector<Pictures> pictures;
  Track odometry, truth;
  std::map<std::string, OwnWords> own;  ///< words in files that Ortung wrote, by topic
  FrameTree frames;
  /// Returns the frames of sensors, which options may mount.
  const std::set<std::string>& sensorFrames() const { return sensorFrames_; }
  std::string base;  ///< frame of the robot
  std::optional<OccupancyGrid> map;
  std::string robotToml;             ///< robot file in a file that Ortung wrote, or ""
  std::vector<std::string> remarks;  ///< remarks for the user

 private:
  void readFile(const std::filesystem::path& file);
  void take(const McapMessage& message, const std::string& type);
  template <class M>
  std::optional<M> decode(const McapMessage& message);
  std::string unpacked(std::string_view packed, const McapMessage& message);
  Timestamp timeOf(const Header& header, const McapMessage& message) const;
  /// Returns the time of a message that is kept, and counts those that are not in order.
  Timestamp stampOf(const Header& header, const McapMessage& message);
  Timestamp inOrder(const std::string& topic, Timestamp stamp);
  void takeScan(const McapMessage& message);
  void takeRange(const McapMessage& message);
  void takeImage(const McapMessage& message);
  void takeOdometry(const McapMessage& message);
  void takeTransforms(const McapMessage& message);
  void takePose(const McapMessage& message);
  void takeMap(const McapMessage& message);
  void takeWords(const McapMessage& message);
  void takeImu(const McapMessage& message);
  std::set<std::string> wantedClouds() const;
  void readClouds(const std::vector<std::filesystem::path>& files);
  void learnMotion();
  void findImu();
  void takeCloud(const McapMessage& message);
  std::optional<CloudShape> shapeOf(const McapMessage& message, const std::string& frame);
  Eigen::Matrix3d tiltAt(Timestamp stamp);
  std::optional<Eigen::Isometry3d> mountOf(const std::string& frame) const;
  void addOwn(const McapMessage& message, Timestamp stamp, std::vector<std::uint32_t> words);
  Timestamp logTime(const McapMessage& message) const;
  bool isTruth(const McapMessage& message) const;
  void addTruth(const McapMessage& message, const Header& header, const Pose& pose);
  void refuse(const McapMessage& message, const std::string& what) const;
  void keep(std::size_t bytes);
  void leaveOut(const McapMessage& message, const char* why);
  void checkChoice() const;
  void needTopic(const char* option, const std::string& topic,
                 std::initializer_list<std::string_view> types) const;
  std::string frameList() const;
  void choose();
  void followFrames();
  void tellTimes();

  /// The times of a topic's messages.
  struct Times {
    Timestamp newest = 0;
    Timestamp farthest = 0;  ///< longest step back [us]
    std::size_t back = 0;    ///< number of messages before the newest one
    std::size_t same = 0;    ///< number of messages at the time of the newest one
  };
  struct TimedTransform {
    Timestamp stamp;
    std::string parent, child;
    Pose2 pose;
    Quaternion attitude;
  };
  BagChoice choice_;
  std::string file_;
  UnpackedSize unpacked_;  ///< size of messages that were compressed one by one
  std::vector<Track> odometries_;
  std::vector<std::string> odometryFrames_;  ///< the robot's frame of each odometry
  std::vector<TimedTransform> moving_;
  std::size_t kept_ = 0;                      ///< size of the readings [bytes]
  std::map<std::string, std::size_t> unfit_;  ///< number of messages by what is said about them
  std::map<std::string, Times> times_;        ///< times by topic
  std::map<std::string, std::set<std::string>, std::less<>> topics_;  ///< topics by type
  std::set<std::string> sensorFrames_;                                ///< frames of sensors
  // What clouds are made to scans with, after all else was read.
  TiltHistory imu_;
  std::string imuFrame_;
  Eigen::Matrix3d imuInBase_ = Eigen::Matrix3d::Identity();
  VelocityHistory velocities_;
};

}  // namespace ortung::ros2
