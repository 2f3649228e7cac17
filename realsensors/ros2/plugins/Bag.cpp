#include "Bag.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "../src/Compression.hpp"
#include "../src/ReadingMessages.hpp"
#include "BagFolder.hpp"
#include "BagTopics.hpp"
#include "MapWorld.hpp"
#include "ortung/camera/ImageData.hpp"
#include "ortung/formats/FormatNames.hpp"
#include "ortung/formats/PoseFixData.hpp"
#include "ortung/realsensors/LogFile.hpp"
#include "ortung/realsensors/LogSource.hpp"
#include "ortung/ros2/RobotTopics.hpp"

namespace ortung::ros2 {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostKept = 1U << 30;  // bytes of readings
constexpr std::size_t kMostRemarks = 32;

std::optional<std::vector<std::string>> listOption(const Parameters& options, const char* key) {
  if (!options.has(key)) return std::nullopt;
  std::vector<std::string> list;
  std::istringstream words(options.text(key));
  for (std::string word; std::getline(words, word, ',');)
    if (!word.empty() && word != "none") list.push_back(word);
  return list;
}

bool isWanted(const std::optional<std::vector<std::string>>& list, const std::string& topic) {
  return !list || std::find(list->begin(), list->end(), topic) != list->end();
}

/// Whether a range was made of a format of a plugin's own, whose words are in a channel beside it.
bool isOfWords(const McapChannel& channel) {
  const auto format = channel.metadata.find("format");
  if (featureOf(channel).empty() || format == channel.metadata.end()) return false;
  return format->second.substr(0, format->second.find(' ')) != formats::kCone;
}

constexpr const char* kNoPlace = "have a place that is no number or beyond 1000 km";

}  // namespace

BagChoice BagChoice::read(const Parameters& options) {
  BagChoice choice;
  choice.scans = listOption(options, "scans");
  choice.ranges = listOption(options, "ranges");
  choice.images = listOption(options, "images");
  choice.odometry = options.textOr("odometry", "");
  choice.truth = options.textOr("truth", "");
  choice.map = options.textOr("map", "");
  choice.base = options.textOr("base", "");
  choice.usesLogTime = options.choiceOr("stamps", "header", {"header", "log"}) == "log";
  choice.clouds = listOption(options, "clouds");
  choice.level = options.textOr("level", "odometry");
  return choice;
}

Bag::Bag(const fs::path& path, const BagChoice& choice) : choice_(choice) {
  const std::vector<fs::path> files = bagFiles(path, remarks);
  for (const fs::path& file : files) readFile(file);
  file_ = path.string();
  checkChoice();
  choose();
  readClouds(files);
  file_ = path.string();
  tellTimes();
  for (const auto& [what, count] : unfit_)
    remarks.push_back(std::to_string(count) + " messages of " + what);
}

void Bag::readFile(const fs::path& file) {
  file_ = file.string();
  const std::unique_ptr<BagFile> reader = openBagFile(file);
  for (McapMessage message; reader->next(message);) take(message, typeOf(*message.channel));
  if (reader->isUnfinished() && remarks.size() < kMostRemarks)
    remarks.push_back(file_ + " is unfinished; it was read up to its end");
  if (std::string robot = reader->robotToml(); !robot.empty()) robotToml = std::move(robot);
}

void Bag::take(const McapMessage& message, const std::string& type) {
  const std::string& topic = message.channel->topic;
  const bool isOurs = !featureOf(*message.channel).empty();
  topics_[type].insert(topic);
  if (type == LaserScan::kType) {
    if (isWanted(choice_.scans, topic)) takeScan(message);
  } else if (type == Range::kType) {
    if (isWanted(choice_.ranges, topic) && !isOfWords(*message.channel)) takeRange(message);
  } else if (type == Imu::kType) {
    if (topic == choice_.level) takeImu(message);
  } else if (type == Image::kType) {
    if (choice_.images ? isWanted(choice_.images, topic) : isOurs) takeImage(message);
  } else if (type == Odometry::kType) {
    takeOdometry(message);
  } else if (type == TfMessage::kType) {
    takeTransforms(message);
  } else if (type == PoseStamped::kType || type == PoseWithCovarianceStamped::kType) {
    takePose(message);
  } else if (type == Words::kType) {
    if (isOurs) takeWords(message);
  } else if (type == OccupancyGrid::kType) {
    if (choice_.map.empty() ? !map : topic == choice_.map) takeMap(message);
  }
}

template <class M>
std::optional<M> Bag::decode(const McapMessage& message) {
  const std::string& encoding = message.channel->encoding;
  const bool isRos1 = encoding == kRos1Encoding;
  if (encoding != "cdr" && !isRos1)
    refuse(message, "found messages in '" + encoding.substr(0, 16) +
                        "', expected cdr, as ROS 2 has them, or ros1");
  std::string why;
  std::optional<M> decoded;
  if (isRos1)
    decoded = fromRos1<M>(message.data, why);
  else if (isZstd(message.data))  // CDR begins with a zero
    decoded = fromCdr<M>(unpacked(message.data, message), why);
  else
    decoded = fromCdr<M>(message.data, why);
  if (!decoded) refuse(message, why + ", expected a " + std::string(M::kType));
  return decoded;
}

template std::optional<Imu> Bag::decode(const McapMessage&);
template std::optional<PointCloud> Bag::decode(const McapMessage&);

/// Unpacks a message, as rosbag2 compresses them one by one.
std::string Bag::unpacked(std::string_view packed, const McapMessage& message) {
  std::string bytes;
  const std::string why = unpackZstd(packed, BagFile::kMostBytes, bytes);
  if (!why.empty()) refuse(message, "found a compressed message that " + why);
  if (!unpacked_.add(packed.size(), bytes.size()))
    refuse(message, "found messages that unpack to more than those of a recording");
  return bytes;
}

void Bag::refuse(const McapMessage& message, const std::string& what) const {
  throw std::runtime_error(file_ + ": topic " + message.channel->topic.substr(0, 80) + ": " + what);
}

void Bag::leaveOut(const McapMessage& message, const char* why) {
  ++unfit_[message.channel->topic.substr(0, 80) + " " + why + ", and were left out"];
}

Timestamp Bag::stampOf(const Header& header, const McapMessage& message) {
  return inOrder(message.channel->topic, timeOf(header, message));
}

Timestamp Bag::inOrder(const std::string& topic, Timestamp stamp) {
  const auto [known, isFirst] = times_.try_emplace(topic, Times{stamp, 0, 0, 0});
  Times& times = known->second;
  if (isFirst || stamp > times.newest) {
    times.newest = stamp;
  } else if (stamp == times.newest) {
    ++times.same;
  } else {
    ++times.back;
    times.farthest = std::max(times.farthest, times.newest - stamp);
  }
  return stamp;
}

/// Tells of times that are not those of a clock.
void Bag::tellTimes() {
  for (const auto& [topic, times] : times_) {
    if (times.back > 0)
      unfit_[topic.substr(0, 80) + " have earlier times than those before them, by up to " +
             tomlNumber(toSeconds(times.farthest)) + " s, and were put in the order of time"] =
          times.back;
    if (times.same > 0)
      unfit_[topic.substr(0, 80) + " have the time of the one before them, and take its place"] =
          times.same;
  }
}

Timestamp Bag::timeOf(const Header& header, const McapMessage& message) const {
  if (choice_.usesLogTime) return logTime(message);
  return header.stamp / 1000 - (header.stamp % 1000 < 0 ? 1 : 0);
}

Timestamp Bag::logTime(const McapMessage& message) const {
  constexpr std::uint64_t kMost = std::uint64_t{1} << 62;
  if (message.logTime > kMost)
    refuse(message,
           "found a time of " + std::to_string(message.logTime) + " ns, expected 2^62 at most");
  return static_cast<Timestamp>(message.logTime / 1000);
}

void Bag::keep(std::size_t bytes) {
  kept_ += bytes;
  if (kept_ > kMostKept)
    throw std::runtime_error(file_ +
                             ": has more than 1 GiB of readings; the options scans, "
                             "ranges and images choose some of them");
}

void Bag::takeScan(const McapMessage& message) {
  const auto scan = *decode<LaserScan>(message);
  Scans& series = ofTopic(scans, *message.channel, file_);
  try {
    if (!series.shape) series.shape.emplace(scan);
  } catch (const std::invalid_argument& error) {
    refuse(message, error.what());
  }
  sensorFrames_.insert(series.shape->frame());
  std::vector<float> fitted = series.shape->fit(scan);
  if (fitted.empty()) return leaveOut(message, "reach beyond the angles of its first one");
  keep(fitted.size() * sizeof(float));
  if (!series.shape->isSame(scan))
    ++unfit_[message.channel->topic +
             " have other beams than its first one, and were fitted to it"];
  series.list.push_back({stampOf(scan.header, message), std::move(fitted)});
}

void Bag::takeRange(const McapMessage& message) {
  const auto range = *decode<Range>(message);
  Ranges& list = ofTopic(ranges, *message.channel, file_);
  if (list.list.empty()) {
    list.frame = range.header.frame;
    sensorFrames_.insert(list.frame);
    list.openingAngle = static_cast<double>(range.fieldOfView);
    list.maxRange = static_cast<double>(range.maxRange);
    if (!(list.openingAngle > 0.0 && list.openingAngle < 3.0) ||
        !(list.maxRange > 0.0 && list.maxRange <= 100.0))
      refuse(message, "found a field of view of " + std::to_string(list.openingAngle) +
                          " rad and a range of " + std::to_string(list.maxRange) +
                          " m, expected up to 3 rad and 100 m");
  }
  keep(sizeof(Reading));
  list.list.push_back({stampOf(range.header, message), metresOf(range)});
}

void Bag::takeImage(const McapMessage& message) {
  const auto image = *decode<Image>(message);
  const bool isGrey = image.encoding == "mono8";
  const bool isBgr = image.encoding == "bgr8";
  const std::size_t channels = isGrey ? 1 : 3;
  if (!isGrey && !isBgr && image.encoding != "rgb8")
    refuse(message, "found pictures in " + inQuotes(image.encoding) +
                        ", expected rgb8, bgr8 or mono8; the option images leaves them out");
  constexpr std::uint32_t kMost = ImageData::kMostSide;
  const std::size_t row = image.width * channels;
  if (image.width < 1 || image.height < 1 || image.width > kMost || image.height > kMost ||
      image.step < row || image.data.size() / image.height < image.step)
    refuse(message, "found a picture of " + std::to_string(image.width) + " x " +
                        std::to_string(image.height) + " in " + std::to_string(image.data.size()) +
                        " bytes, expected as many as it has, and 4096 x 4096 at most");
  Pictures& list = ofTopic(pictures, *message.channel, file_);
  list.frame = image.header.frame;
  sensorFrames_.insert(list.frame);
  Picture& picture = list.list.emplace_back();
  picture.stamp = stampOf(image.header, message);
  ImageData::start({static_cast<int>(image.width), static_cast<int>(image.height)},
                   isGrey ? PixelFormat::kGrey : PixelFormat::kRgb, picture.words);
  keep(picture.words.size() * sizeof(std::uint32_t));
  std::uint8_t* to = ImageData::pixelsOf(picture.words).data();
  for (std::size_t y = 0; y < image.height; ++y, to += row)
    std::copy_n(image.data.data() + y * image.step, row, to);
  if (!isBgr) return;
  for (std::uint8_t* pixel = to - row * image.height; pixel < to; pixel += channels)
    std::swap(pixel[0], pixel[2]);
}

bool Bag::isTruth(const McapMessage& message) const {
  const std::string& topic = message.channel->topic;
  if (!choice_.truth.empty()) return topic == choice_.truth;
  return topic.find("ground_truth") != topic.npos || topic.find("groundtruth") != topic.npos;
}

void Bag::addTruth(const McapMessage& message, const Header& header, const Pose& pose) {
  if (truth.topic.empty()) {
    truth.topic = message.channel->topic;
    truth.feature = featureOf(*message.channel);
  }
  if (message.channel->topic != truth.topic) return;
  const Pose2 planar = toPose2(pose);
  if (!isPlausible(planar)) return leaveOut(message, kNoPlace);
  keep(sizeof(Moving));
  truth.list.push_back({stampOf(header, message), planar});
}

void Bag::takeOdometry(const McapMessage& message) {
  const auto odom = *decode<Odometry>(message);
  if (isTruth(message)) return addTruth(message, odom.header, odom.pose);
  const Pose2 pose = toPose2(odom.pose);
  if (!isPlausible(pose)) return leaveOut(message, kNoPlace);
  for (const double velocity : {odom.linear.x, odom.linear.y, odom.angular.z})
    if (!(std::abs(velocity) <= kMaxLogVelocity))
      return leaveOut(message, "have a velocity that is no number or above 100 m/s or rad/s");
  Track& track = ofTopic(odometries_, *message.channel, file_);
  if (odometryFrames_.size() < odometries_.size()) odometryFrames_.push_back(odom.childFrame);
  keep(sizeof(Moving));
  const Timestamp stamp = stampOf(odom.header, message);
  track.list.push_back({stamp, pose, odom.linear.x, odom.linear.y, odom.angular.z});
  track.tilts.add(stamp, odom.pose.orientation);
}

void Bag::takeTransforms(const McapMessage& message) {
  const bool isStatic = message.channel->topic.ends_with("tf_static");
  const auto transforms = *decode<TfMessage>(message);
  bool isWhole = true;
  for (const TransformStamped& one : transforms.transforms) {
    const Pose2 pose = toPose2(one.transform);
    const bool isUsed = frames.add(one, isStatic) && isPlausible(pose);
    isWhole = isWhole && isUsed;
    if (isStatic || !isUsed) continue;
    keep(sizeof(TimedTransform));
    moving_.push_back({timeOf(one.header, message), one.header.frame, one.childFrame, pose,
                       one.transform.orientation});
  }
  if (!isWhole) leaveOut(message, "have transforms that are no numbers or beyond 1000 km");
}

void Bag::takePose(const McapMessage& message) {
  if (typeOf(*message.channel) == PoseStamped::kType) {
    if (!isTruth(message)) return;
    const auto pose = *decode<PoseStamped>(message);
    return addTruth(message, pose.header, pose.pose);
  }
  const bool isEstimate = featureOf(*message.channel) == "mcl/LOCALIZATION/pose";
  if (!isTruth(message) && !isEstimate) return;
  const auto pose = *decode<PoseWithCovarianceStamped>(message);
  if (!isEstimate) return addTruth(message, pose.header, pose.pose);
  const PoseFixData::Fix fix{toPose2(pose.pose), toPlane(pose.covariance)};
  bool isNumber = isPlausible(fix.pose);
  for (std::size_t i = 0; i < fix.covariance.size(); ++i)
    isNumber =
        isNumber && std::isfinite(fix.covariance[i]) && (i % 4 != 0 || fix.covariance[i] >= 0);
  if (!isNumber) return leaveOut(message, kNoPlace);
  addOwn(message, stampOf(pose.header, message), PoseFixData::encode({&fix, 1}));
}

void Bag::addOwn(const McapMessage& message, Timestamp stamp, std::vector<std::uint32_t> words) {
  keep(sizeof(Picture) + words.size() * sizeof(std::uint32_t));
  if (own.size() >= kMostTopics && !own.contains(message.channel->topic))
    refuse(message, "found one more topic of Ortung's own, expected 1024 at most");
  OwnWords& topic = own[message.channel->topic];
  topic.feature = featureOf(*message.channel);
  topic.list.push_back({stamp, std::move(words)});
}

/// Takes words of Ortung's features. Their messages have no stamp but the time of recording.
void Bag::takeWords(const McapMessage& message) {
  addOwn(message, logTime(message), decode<Words>(message)->data);
}

void Bag::takeMap(const McapMessage& message) {
  map = *decode<OccupancyGrid>(message);
  if (const std::string why = whyNoWorld(*map); !why.empty()) refuse(message, why);
}

/// Throws unless there are messages of one of the types at a topic that an option names.
void Bag::needTopic(const char* option, const std::string& topic,
                    std::initializer_list<std::string_view> types) const {
  std::set<std::string> there;
  for (const std::string_view type : types)
    if (const auto found = topics_.find(type); found != topics_.end())
      there.insert(found->second.begin(), found->second.end());
  if (there.contains(topic)) return;
  throw std::runtime_error(file_ + ": found no message at the topic " + inQuotes(topic) +
                           " that the option " + option + " names, expected one with " +
                           std::string(*types.begin()) + ": " + listOf(there));
}

/// Throws for options that name topics which are not there.
void Bag::checkChoice() const {
  const auto needAll = [&](const char* option, const std::optional<std::vector<std::string>>& list,
                           std::string_view type) {
    for (const std::string& topic : list.value_or(std::vector<std::string>()))
      needTopic(option, topic, {type});
  };
  needAll("scans", choice_.scans, LaserScan::kType);
  needAll("ranges", choice_.ranges, Range::kType);
  needAll("images", choice_.images, Image::kType);
  needAll("clouds", choice_.clouds, PointCloud::kType);
  if (isLevelledByTopic(choice_.level)) needTopic("level", choice_.level, {Imu::kType});
  if (!choice_.odometry.empty() && choice_.odometry != "tf")
    needTopic("odometry", choice_.odometry, {Odometry::kType});
  if (!choice_.truth.empty() && choice_.truth != "tf" && choice_.truth != "none")
    needTopic("truth", choice_.truth,
              {PoseStamped::kType, PoseWithCovarianceStamped::kType, Odometry::kType});
  if (!choice_.map.empty()) needTopic("map", choice_.map, {OccupancyGrid::kType});
}

/// Returns all frames of which the bag tells, for errors.
std::string Bag::frameList() const {
  std::set<std::string> all = frames.frames();
  all.insert(sensorFrames_.begin(), sensorFrames_.end());
  all.insert(odometryFrames_.begin(), odometryFrames_.end());
  return listOf(all);
}

/// Chooses odometry, ground truth and the robot's frame, after all messages were read.
void Bag::choose() {
  const std::string& wanted = choice_.odometry;
  std::size_t at = 0;
  while (at < odometries_.size() && !wanted.empty() && odometries_[at].topic != wanted) ++at;
  if (at < odometries_.size()) {
    odometry = std::move(odometries_[at]);
    base = odometryFrames_[at];
  }
  if (!choice_.base.empty()) {
    base = choice_.base;
    const bool isThere =
        frames.frames().contains(base) || sensorFrames_.contains(base) ||
        std::find(odometryFrames_.begin(), odometryFrames_.end(), base) != odometryFrames_.end();
    if (!isThere)
      throw std::runtime_error(file_ + ": found no frame " + inQuotes(base) +
                               " that the option base names, expected one of " + frameList());
  }
  if (base.empty()) base = frames.hasFrame("base_footprint") ? "base_footprint" : "base_link";
  followFrames();
  if (wanted == "tf" && odometry.list.empty())
    throw std::runtime_error(file_ + ": found no transform to the frame " + inQuotes(base) +
                             " at /tf, expected the robot's odometry there; frames are " +
                             frameList() + ", and the option base names the robot's");
  if (choice_.truth == "tf") truth.topic = "/tf";
  if (!choice_.truth.empty() && choice_.truth != "none" && truth.list.empty())
    throw std::runtime_error(file_ + ": found no pose that may be one at " +
                             inQuotes(choice_.truth) + "; the option truth names it");
}

/// Takes the robot's way from the transforms.
void Bag::followFrames() {
  std::string inOdometry;  // the frame in which the robot moves
  std::optional<Pose2> odometryInMap;
  for (const TimedTransform& one : moving_) {
    if (one.child == base) {
      inOdometry = one.parent;
      if (odometry.topic.empty() || odometry.topic == "/tf") {
        odometry.topic = "/tf";
        odometry.list.push_back({inOrder("/tf to the robot", one.stamp), one.pose});
        odometry.tilts.add(one.stamp, one.attitude);
      }
      if (choice_.truth == "tf" && odometryInMap)
        truth.list.push_back({one.stamp, *odometryInMap * one.pose});
    } else if (one.child == inOdometry) {
      odometryInMap = one.pose;
    }
  }
}

}  // namespace ortung::ros2
