#include "ortung/ros2/RobotTopics.hpp"

#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>

#include "ReadingMessages.hpp"
#include "ortung/camera/ImageData.hpp"
#include "ortung/formats/FormatNames.hpp"
#include "ortung/formats/OdometryData.hpp"
#include "ortung/formats/PoseData.hpp"
#include "ortung/formats/PoseFixData.hpp"
#include "ortung/formats/ProtectionData.hpp"
#include "ortung/formats/ScanData.hpp"
#include "ortung/formats/TrackData.hpp"

namespace ortung::ros2 {
namespace {

constexpr const char* kMap = "map";
constexpr const char* kTruths = "*/groundTruth/*";
const SensorId kEstimate{"mcl", "LOCALIZATION", "pose"};
const SensorId kSamples{"mcl", "LOCALIZATION", "samples"};
const SensorId kSmooth{"mcl", "LOCALIZATION", "smooth"};
const SensorId kTrack{"mcl", "LOCALIZATION", "status"};
const SensorId kProtection{"mcl", "LOCALIZATION", "protection"};
const SensorId kChanges{"mcl", "LOCALIZATION", "map"};

/// Part of a name as ROS has them: letters, digits and '_', no digit first.
std::string cleaned(const std::string& name) {
  std::string text;
  for (const char c : name) {
    const bool isPlain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    text += isPlain ? c : '_';
  }
  return text[0] >= '0' && text[0] <= '9' ? "n" + text : text;
}

TransformStamped transform(std::string frame, std::string child, const Pose2& pose,
                           std::int64_t stamp) {
  return {{stamp, std::move(frame)}, std::move(child), fromPose2(pose)};
}

}  // namespace

struct RobotTopics::Parts {
  /// A feature and where its readings go.
  struct Route {
    const SensorData* data = nullptr;
    std::size_t topic = 0;
    std::string frame;  ///< of the sensor
    Format format{formats::kOdometry};
    bool keepsWords = true;  ///< whether the words can be read from its message
  };
  const SensorContainer& container;
  MapFrame mapFrame = MapFrame::kBest;
  std::string topicStart, frameStart;  ///< of the names that are this robot's alone
  std::string odom, base;              ///< frames
  std::vector<Topic> topics;
  std::set<std::string> names;
  std::map<std::string, Route> routes;  ///< by feature
  std::size_t tf = 0, tfStatic = 0, map = 0, pose = 0, smooth = 0, samples = 0, truth = 0,
              diagnostics = 0, changes = 0;
  std::string part;      ///< name of the localization, for diagnostics
  std::string odometry;  ///< the feature that the frame of odometry is of; "": none
  std::optional<Pose2> inOdometry, newTruth, newEstimate;
  std::optional<TrackData::Reading> newTrack;
  ProtectionData::Reading bound;            ///< the newest one
  std::vector<std::uint32_t> shownChanges;  ///< words of the map's changes that went out last
  bool isEstimated = false;
  std::map<std::string, std::size_t> words;  ///< topic by feature

  std::size_t addTopic(std::string name, std::string_view type, bool isLatched = false,
                       const std::string& feature = "") {
    const std::string wanted = name;
    for (int i = 2; !names.insert(name).second; ++i) name = wanted + "_" + std::to_string(i);
    topics.push_back({std::move(name), type, isLatched, feature, formatOf(feature)});
    return topics.size() - 1;
  }
  explicit Parts(const SensorContainer& features) : container(features) {}
  std::string formatOf(const std::string& feature) const {
    for (const auto& data : container.all())
      if (toText(data->id()) == feature) return data->format().toText();
    return "";
  }
  void addFeatures();
  std::size_t addWords(const SensorId& id);
  void take(const Message& message, const Sink& sink);
  void sendWords(const Message& message, const Sink& sink);
  void noteTrust(const Message& message, const Sink& sink);
  bool takeOwn(const Message& message, std::int64_t stamp, const Sink& sink);
  void sendTransforms(Timestamp stamp, const Sink& sink);
  void sendDiagnostics(Timestamp stamp, const Sink& sink);
};

namespace {

/// Ground truth and what MCL says have topics of their own.
bool isOwn(const SensorId& id) {
  return id.type == "groundTruth" || id == kEstimate || id == kSamples;
}

/// What ROS has for a feature.
struct Kind {
  std::string topic;  ///< what its name begins with; empty if ROS has no message for the format
  std::string_view type;
  bool keepsWords = true;  ///< whether the words can be read from the message
};

Kind kindOf(const SensorData& data) {
  const Format whole = data.format();
  const std::string& format = whole.name();
  if (format == formats::kOdometry) return {"/odom", Odometry::kType};
  if (format == formats::kScan) return {"/scan", LaserScan::kType};
  if (format == formats::kCone) return {"/range", Range::kType};
  if (format == formats::kImage) return {"/image", Image::kType};
  if (isOwn(data.id())) return {};
  if (format == formats::kFix) return {"/pose_fix", PoseWithCovarianceStamped::kType};
  switch (rowKindOf(whole)) {
    case RowKind::kPlaces:
      return {"/points", PointCloud::kType, false};
    case RowKind::kRanges:
      return {"/range", Range::kType, false};
    case RowKind::kOther:
      break;
  }
  return {};
}

}  // namespace

void RobotTopics::Parts::addFeatures() {
  std::map<std::string, int> count;
  for (const auto& data : container.all()) ++count[kindOf(*data).topic];
  for (const auto& data : container.all()) {
    const auto [name, type, keepsWords] = kindOf(*data);
    const SensorId& id = data->id();
    if (name.empty()) {
      if (!isOwn(id)) addWords(id);
      continue;
    }
    const bool isOdometry = type == Odometry::kType;
    const std::string feature = toText(id);
    const std::string own = cleaned(id.model) + "/" + cleaned(id.feature);
    const bool isFirstOdometry = isOdometry && odometry.empty();
    if (isFirstOdometry) odometry = feature;
    const bool isShort = isFirstOdometry || (count[name] == 1 && name != "/range");
    const std::size_t topic =
        addTopic(topicStart + (isShort ? name : name + "/" + own), type, false, feature);
    if (!keepsWords) addWords(id);
    routes[feature] = {data.get(), topic,
                       frameStart + cleaned(id.model) + "_" + cleaned(id.feature), data->format(),
                       keepsWords};
  }
}

RobotTopics::RobotTopics(const SensorContainer& container, const Options& options)
    : parts_(std::make_unique<Parts>(container)) {
  Parts& p = *parts_;
  p.mapFrame = options.mapFrame;
  p.frameStart = options.framePrefix;
  if (!options.robot.empty()) {
    p.frameStart = cleaned(options.robot) + "/";
    p.topicStart = "/" + cleaned(options.robot);
  }
  p.part = (options.robot.empty() ? "" : options.robot + ": ") + "localization";
  p.odom = p.frameStart + options.odom;
  p.base = p.frameStart + options.base;
  p.tfStatic = p.addTopic("/tf_static", TfMessage::kType, true);
  p.map = p.addTopic("/map", OccupancyGrid::kType, true);
  p.tf = p.addTopic("/tf", TfMessage::kType);
  p.addFeatures();
  p.truth = p.addTopic(p.topicStart + "/ground_truth", PoseStamped::kType);
  p.pose = p.addTopic(p.topicStart + "/pose", PoseWithCovarianceStamped::kType, false,
                      toText(kEstimate));
  p.smooth = p.addTopic(p.topicStart + "/smooth_pose", PoseStamped::kType);
  p.diagnostics = p.addTopic("/diagnostics", DiagnosticArray::kType);
  p.changes = p.addTopic(p.topicStart + "/map_changes", OccupancyGrid::kType, true);
  p.samples = p.addTopic(p.topicStart + "/particle_cloud", PoseArray::kType);
}

RobotTopics::~RobotTopics() = default;

const std::vector<Topic>& RobotTopics::topics() const { return parts_->topics; }

void RobotTopics::addWords(const SensorId& feature) { parts_->addWords(feature); }

std::vector<std::string> RobotTopics::featuresOf(std::size_t topic) const {
  const Parts& p = *parts_;
  if (topic == p.truth) return {kTruths};
  if (topic == p.samples) return {toText(kSamples)};
  if (topic == p.smooth) return {toText(kSmooth)};
  if (topic == p.changes) return {toText(kChanges)};
  if (topic == p.diagnostics) return {toText(kTrack), toText(kProtection)};
  if (topic == p.tf) {
    std::vector<std::string> features{kTruths, toText(kEstimate)};
    if (!p.odometry.empty()) features.push_back(p.odometry);
    return features;
  }
  const std::string& feature = p.topics[topic].feature;
  return feature.empty() ? std::vector<std::string>() : std::vector<std::string>{feature};
}

void RobotTopics::start(Timestamp stamp, const Sink& sink) const {
  TfMessage mounts;
  for (const auto& [feature, route] : parts_->routes) {
    if (feature == parts_->odometry) continue;
    mounts.transforms.push_back(
        transform(parts_->base, route.frame, route.data->mount(), rosTime(stamp)));
  }
  sink(parts_->tfStatic, stamp, toCdr(mounts));
}

void RobotTopics::show(OccupancyGrid map, Timestamp stamp, const Sink& sink) const {
  map.header = {rosTime(stamp), kMap};
  map.mapLoadTime = map.header.stamp;
  sink(parts_->map, stamp, toCdr(map));
}

/// What no feature of the container is: ground truth and what MCL says.
bool RobotTopics::Parts::takeOwn(const Message& message, std::int64_t stamp, const Sink& sink) {
  const Header inMap{stamp, kMap};
  if (message.id.type == "groundTruth") {
    PoseData data(message.id);
    data.setData(message.stamp, message.words);
    newTruth = data.reading();
    topics[truth].feature = toText(message.id);
    sink(truth, message.stamp, toCdr(PoseStamped{inMap, fromPose2(*newTruth)}));
  } else if (message.id == kEstimate) {
    const auto estimate = poseMessage(message, inMap);
    if (!estimate) return true;
    newEstimate = toPose2(estimate->pose);
    sink(pose, message.stamp, toCdr(*estimate));
  } else if (message.id == kSamples) {
    sink(samples, message.stamp, toCdr(samplesMessage(message, inMap)));
  } else {
    return false;
  }
  return true;
}

/// Notes how far MCL can be relied on. Its words go out, too.
void RobotTopics::Parts::noteTrust(const Message& message, const Sink& sink) {
  if (message.id == kSmooth) {
    PoseData data(message.id);
    data.setData(message.stamp, message.words);
    const Header inMap{rosTime(message.stamp), kMap};
    sink(smooth, message.stamp, toCdr(PoseStamped{inMap, fromPose2(data.reading())}));
  } else if (message.id == kChanges) {
    if (std::exchange(shownChanges, message.words) == message.words) return;
    const auto grid = changesMessage(message, {rosTime(message.stamp), kMap});
    if (grid) sink(changes, message.stamp, toCdr(*grid));
  } else if (message.id == kTrack) {
    TrackData track;
    track.setData(message.stamp, message.words);
    newTrack = track.reading();
  } else if (message.id == kProtection) {
    ProtectionData protection;
    protection.setData(message.stamp, message.words);
    bound = protection.reading();
  }
}

void RobotTopics::Parts::take(const Message& message, const Sink& sink) {
  const std::int64_t stamp = rosTime(message.stamp);
  if (takeOwn(message, stamp, sink)) return;
  noteTrust(message, sink);
  const std::string feature = toText(message.id);
  const auto found = routes.find(feature);
  if (found == routes.end()) return sendWords(message, sink);
  const Route& route = found->second;
  route.data->checkData(message.words);
  if (!route.keepsWords) sendWords(message, sink);
  const Header here{stamp, route.frame};
  const auto send = [&](const auto& out) { sink(route.topic, message.stamp, toCdr(out)); };
  const Format& format = route.format;
  if (format.name() == formats::kOdometry) {
    const Odometry moved = odometryMessage(message, {stamp, odom}, base);
    if (feature == odometry) inOdometry = toPose2(moved.pose);
    send(moved);
    if (hasMotionData(message)) sendWords(message, sink);
  } else if (format.name() == formats::kScan) {
    send(scanMessage(message, ScanData::configOf(format), here));
  } else if (format.name() == formats::kCone) {
    send(rangeMessage(message, format, here));
  } else if (format.name() == formats::kImage) {
    send(imageMessage(message, here));
  } else if (format.name() == formats::kFix) {
    if (const auto fix = poseMessage(message, {stamp, kMap})) send(*fix);
  } else if (rowKindOf(format) == RowKind::kPlaces) {
    send(cloudMessage(message, format, areInRobot(format) ? Header{stamp, base} : here));
  } else if (const auto range = rowRangeMessage(message, format, here)) {
    send(*range);
  }
}

std::size_t RobotTopics::Parts::addWords(const SensorId& id) {
  const std::string feature = toText(id);
  if (const auto known = words.find(feature); known != words.end()) return known->second;
  const std::string name = topicStart + "/ortung/" + cleaned(id.model) + "/" + cleaned(id.type) +
                           "/" + cleaned(id.feature);
  return words[feature] = addTopic(name, Words::kType, false, feature);
}

void RobotTopics::Parts::sendWords(const Message& message, const Sink& sink) {
  const SensorId& id = message.id;
  sink(addWords(id), message.stamp, toCdr(Words{{}, 0, message.words}));
}

/// Where the robot is in the frame of odometry, and where that is in the map.
void RobotTopics::Parts::sendTransforms(Timestamp stamp, const Sink& sink) {
  TfMessage moved;
  if (inOdometry) moved.transforms.push_back(transform(odom, base, *inOdometry, rosTime(stamp)));
  isEstimated = isEstimated || newEstimate.has_value();
  const std::optional<Pose2>& inMap =
      mapFrame == MapFrame::kBest && isEstimated ? newEstimate : newTruth;
  if (inMap && mapFrame != MapFrame::kNone) {
    const bool hasOdometry = inOdometry.has_value();
    if (hasOdometry || odometry.empty())
      moved.transforms.push_back(transform(kMap, hasOdometry ? odom : base,
                                           hasOdometry ? *inMap * inverse(*inOdometry) : *inMap,
                                           rosTime(stamp)));
  }
  newTruth.reset();
  newEstimate.reset();
  if (!moved.transforms.empty()) sink(tf, stamp, toCdr(moved));
}

/// How far MCL's newest estimate can be relied on, if that was told anew.
void RobotTopics::Parts::sendDiagnostics(Timestamp stamp, const Sink& sink) {
  if (!newTrack) return;
  sink(diagnostics, stamp,
       toCdr(diagnosticsMessage(*std::exchange(newTrack, std::nullopt), bound, part,
                                {rosTime(stamp), ""})));
}

void RobotTopics::take(std::span<const Message> frame, const Sink& sink) {
  for (const Message& message : frame) parts_->take(message, sink);
  bool isMoved = parts_->newTruth || parts_->newEstimate;
  for (const Message& message : frame) isMoved |= toText(message.id) == parts_->odometry;
  if (isMoved) parts_->sendTransforms(frame.front().stamp, sink);
  if (!frame.empty()) parts_->sendDiagnostics(frame.front().stamp, sink);
}

}  // namespace ortung::ros2
