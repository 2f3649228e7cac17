// What a bag's clouds are made to scans with: where lidars sit, how the robot leans and moves. As
// all of that may be told later than the clouds, they are read last, on another way through the
// files, and one at a time: they are large.
#include <algorithm>
#include <stdexcept>

#include "Bag.hpp"
#include "BagTopics.hpp"
#include "ortung/realsensors/LogFile.hpp"

namespace ortung::ros2 {

void Bag::takeImu(const McapMessage& message) {
  const auto imu = *decode<Imu>(message);
  if (imu.orientationCovariance[0] < 0.0 ||  // which says that there is none
      !imu_.add(stampOf(imu.header, message), imu.orientation))
    return leaveOut(message, "have no orientation");
  keep(sizeof(Timestamp) + sizeof(std::array<float, 3>));
  if (imuFrame_.empty()) imuFrame_ = imu.header.frame;
  sensorFrames_.insert(imuFrame_);
}

/// Returns the topics whose clouds are read. Those of files that Ortung wrote are no lidar's.
std::set<std::string> Bag::wantedClouds() const {
  if (choice_.clouds) return {choice_.clouds->begin(), choice_.clouds->end()};
  const auto all = topics_.find(PointCloud::kType);
  if (!scans.empty() || all == topics_.end()) return {};
  return all->second;
}

void Bag::readClouds(const std::vector<std::filesystem::path>& files) {
  const std::set<std::string> wanted = wantedClouds();
  for (const auto& [topic, heights] : choice_.bands.heights)
    if (!wanted.contains(topic))
      throw std::runtime_error(file_ + ": found no cloud that is read at the topic " +
                               inQuotes(topic) + " that the option band names, expected one of " +
                               listOf(wanted));
  if (wanted.empty()) return;
  learnMotion();
  unpacked_ = {};
  for (const std::filesystem::path& file : files) {
    file_ = file.string();
    const std::unique_ptr<BagFile> reader = openBagFile(file);
    for (McapMessage message; reader->next(message);)
      if (typeOf(*message.channel) == PointCloud::kType &&
          wanted.contains(message.channel->topic) && featureOf(*message.channel).empty())
        takeCloud(message);
  }
}

/// Takes velocities and attitudes from what was read.
void Bag::learnMotion() {
  std::vector<Moving> list = odometry.list;
  std::stable_sort(list.begin(), list.end(),
                   [](const Moving& a, const Moving& b) { return a.stamp < b.stamp; });
  const bool isOfFrames = odometry.topic == "/tf";
  for (const Moving& one : list) {
    if (isOfFrames)
      velocities_.addPose(one.stamp, one.pose);
    else
      velocities_.add(one.stamp, {one.forward, one.left, one.turn});
  }
  if (imu_.isEmpty()) return;
  if (const auto found = mountOf(imuFrame_))
    imuInBase_ = found->linear();
  else
    remarks.push_back("how the frame " + inQuotes(imuFrame_) + " of " + choice_.level +
                      " lies in " + inQuotes(base) +
                      " is not known: it was taken to be turned as the robot; the " +
                      "option mounts sets it");
}

std::optional<Eigen::Isometry3d> Bag::mountOf(const std::string& frame) const {
  if (const auto told = choice_.mounts.find(frame); told != choice_.mounts.end())
    return told->second;
  return frames.find(frame, base);
}

/// Returns what makes scans of the clouds of a lidar; nothing where it is not known how high it
/// sits, unless an option asks for it: then that is an error.
std::optional<CloudShape> Bag::shapeOf(const McapMessage& message, const std::string& frame) {
  if (const auto mount = mountOf(frame))
    return CloudShape(choice_.bands.of(message.channel->topic), *mount);
  const std::string what = "the mount of frame " + inQuotes(frame) + " of " +
                           message.channel->topic.substr(0, 80) + " in " + inQuotes(base) +
                           " is not known";
  if (choice_.clouds)
    throw std::runtime_error(file_ + ": " + what +
                             ", expected it at /tf_static, or in the option mounts as "
                             "FRAME:x,y,theta,z,roll,pitch");
  remarks.push_back(what + ": its clouds were left out; the option mounts sets it");
  return std::nullopt;
}

Eigen::Matrix3d Bag::tiltAt(Timestamp stamp) {
  if (choice_.level == "none") return Eigen::Matrix3d::Identity();
  const bool isByTopic = isLevelledByTopic(choice_.level);
  const auto tilt = isByTopic ? imu_.at(stamp, imuInBase_)
                              : odometry.tilts.at(stamp, Eigen::Matrix3d::Identity());
  if (!tilt && isByTopic)
    ++unfit_["clouds have no attitude of their time at " + choice_.level.substr(0, 80) +
             ", and were not levelled"];
  return tilt.value_or(Eigen::Matrix3d::Identity());
}

void Bag::takeCloud(const McapMessage& message) {
  const bool isFirst = std::none_of(clouds.begin(), clouds.end(), [&](const Clouds& one) {
    return one.topic == message.channel->topic;
  });
  const auto cloud = *decode<PointCloud>(message);
  Clouds& series = ofTopic(clouds, *message.channel, file_);
  if (isFirst) {
    sensorFrames_.insert(cloud.header.frame);
    series.shape = shapeOf(message, cloud.header.frame);
  }
  if (!series.shape) return;
  const Timestamp stamp = stampOf(cloud.header, message);
  std::string why;
  const auto layout = CloudLayout::of(cloud, why);
  std::span<const float> found;
  if (layout)
    found = series.shape->fit(
        *layout,
        motionDuring(
            layout->sweep(), stamp, [this](Timestamp at) { return tiltAt(at); }, velocities_),
        why);
  if (!found.empty()) {
    keep(found.size_bytes());
    series.list.push_back({stamp, {found.begin(), found.end()}});
  } else if (why == CloudShape::kNoPoint) {
    leaveOut(message, "have no point in the band of heights and ranges");
  } else if (series.list.empty()) {
    refuse(message, why);
  } else {
    leaveOut(message, "have fields or sizes that their bytes do not have");
  }
}

}  // namespace ortung::ros2
