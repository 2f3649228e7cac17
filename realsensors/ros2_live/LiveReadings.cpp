#include "LiveReadings.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "ortung/base/Angles.hpp"
#include "ortung/formats/OdometryData.hpp"
#include "ortung/formats/ScanData.hpp"
#include "ortung/realsensors/LogFile.hpp"
#include "ortung/ros2/Messages.hpp"
#include "ortung/ros2/RobotTopics.hpp"

namespace ortung::ros2 {
namespace {

constexpr std::size_t kMostWaiting = 4096;  ///< moments; at 50 Hz more than a minute
constexpr std::size_t kMostReasons = 64;
/// Late messages in a row, after which it is the clock that was set back.
constexpr std::size_t kClockWasSet = 100;

/// How far a scan may be ahead of odometry: one from another clock would make all others late [us].
constexpr Timestamp kMostAhead = 1'000'000;

}  // namespace

LiveReadings::LiveReadings(Options options)
    : options_(std::move(options)),
      shapes_(options_.scanners.size()),
      areUpsideDown_(options_.scanners.size()),
      tilts_(kMostWaiting),
      velocities_(kMostWaiting) {
  for (const Scanner& scanner : options_.scanners) streams_.expect(scanner.feature);
  for (const Lidar& lidar : options_.lidars) {
    streams_.expect(lidar.feature);
    lidar.band.check();
    clouds_.push_back(std::make_unique<Cloud>());
  }
}

void LiveReadings::leaveOut(const std::string& what) {
  if (leftOut_.size() < kMostReasons || leftOut_.contains(what)) ++leftOut_[what];
}

/// Puts a reading to those of its time.
void LiveReadings::put(Message message, std::optional<Pose2> inOdometry) {
  if (delivered_ && message.stamp < *delivered_) {
    leaveOut(toText(message.id) + ": late");
    if (++late_ < kClockWasSet) return;
    leaveOut("the clock was set back");
    waiting_.clear();
    delivered_.reset();
    lastPose_.reset();
    newestScan_.reset();
    newestOdometry_.reset();
    streams_.forget();
    tilts_ = TiltHistory(kMostWaiting);
    velocities_ = VelocityHistory(kMostWaiting);
  }
  late_ = 0;
  if (waiting_.size() >= kMostWaiting && !waiting_.contains(message.stamp))
    return leaveOut(toText(message.id) + ": too many that wait");
  Waiting& moment = waiting_[message.stamp];
  if (moment.readings.empty()) moment.since = Clock::now();
  std::erase_if(moment.readings, [&](const Message& one) { return one.id == message.id; });
  moment.readings.push_back(std::move(message));
  if (inOdometry) moment.inOdometry = inOdometry;
}

void LiveReadings::takeScan(std::size_t scanner, std::string_view cdr) {
  const Scanner& wanted = options_.scanners.at(scanner);
  std::string why;
  const auto scan = fromCdr<LaserScan>(cdr, why);
  const std::lock_guard lock(mutex_);
  if (!scan) return leaveOut(wanted.topic + ": no scan: " + why);
  std::optional<ScanShape>& shape = shapes_[scanner];
  try {
    if (!shape) {
      ScanShape first(*scan);
      const auto mount = frames_.find(first.frame(), options_.base);
      const bool isUpsideDown = mount && onPlane(*mount).isUpsideDown();
      const std::size_t beams = first.fit(*scan).size();
      if (beams != wanted.beams)
        return leaveOut(wanted.topic + ": " + std::to_string(beams) + " beams, but " +
                        toText(wanted.feature) + " has " + std::to_string(wanted.beams));
      shape = std::move(first);
      areUpsideDown_[scanner] = isUpsideDown;
    }
  } catch (const std::invalid_argument& error) {
    return leaveOut(wanted.topic + ": " + error.what());
  }
  const std::vector<float> ranges = shape->fit(*scan);
  if (ranges.empty()) return leaveOut(wanted.topic + ": beams beyond the angles of the first scan");
  Message reading{stampOf(scan->header), wanted.feature, {}};
  ScanData::encode(ranges, wanted.maxRange, reading.words);
  if (shape->isClockwise() != areUpsideDown_[scanner])
    std::reverse(reading.words.begin(), reading.words.end());
  putScan(std::move(reading), wanted.topic);
}

void LiveReadings::takeFeature(std::size_t feature, std::string_view cdr) {
  const LiveFeature& wanted = options_.features.at(feature);
  try {
    Message reading = wanted.read(cdr);
    const std::lock_guard lock(mutex_);
    putScan(std::move(reading), wanted.topic);
  } catch (const std::invalid_argument& error) {
    const std::lock_guard lock(mutex_);
    leaveOut(wanted.topic + ": " + error.what());
  }
}

void LiveReadings::putScan(Message reading, const std::string& topic) {
  if (newestOdometry_ && reading.stamp > *newestOdometry_ + kMostAhead)
    return leaveOut(topic + ": more than 1 s ahead of odometry");
  ++taken_[topic];
  newestScan_ = std::max(newestScan_.value_or(reading.stamp), reading.stamp);
  streams_.take(reading.id, reading.stamp, Clock::now());
  put(std::move(reading), std::nullopt);
  arrived_.notify_all();
}

/// Makes a scan of a cloud, while others may take what arrives: it has megabytes.
void LiveReadings::takeCloud(std::size_t lidar, std::string_view cdr) {
  const Lidar& wanted = options_.lidars.at(lidar);
  Cloud& own = *clouds_.at(lidar);
  const std::lock_guard oneByOne(own.mutex);
  std::string why;
  const bool isCloud = fromCdr(cdr, own.message, why);
  const auto layout = isCloud ? CloudLayout::of(own.message, why) : std::nullopt;
  SweepMotion motion;
  {
    const std::lock_guard lock(mutex_);
    if (!isCloud) return leaveOut(wanted.topic + ": no cloud: " + why);
    if (!layout) return leaveOut(wanted.topic + ": " + why);
    if (!own.shape) {
      const auto mount = frames_.find(own.message.header.frame, options_.base);
      if (!mount) return leaveOut(wanted.topic + ": no transform tells where the lidar sits");
      own.shape.emplace(wanted.band, *mount);
    }
    motion = motionDuring(
        layout->sweep(), layout->stamp(), [this](Timestamp at) { return tiltAt(at); }, velocities_);
  }
  const auto ranges = own.shape->fit(*layout, motion, why);
  const std::lock_guard lock(mutex_);
  if (ranges.empty()) return leaveOut(wanted.topic + ": " + why);
  Message reading{layout->stamp(), wanted.feature, {}};
  ScanData::encode(ranges, wanted.band.maxRange, reading.words);
  putScan(std::move(reading), wanted.topic);
}

/// Returns how the robot leans, as far as it is told.
Eigen::Matrix3d LiveReadings::tiltAt(Timestamp stamp) {
  Eigen::Matrix3d unit = Eigen::Matrix3d::Identity();
  if (!imuFrame_.empty()) {
    const auto mount = frames_.find(imuFrame_, options_.base);
    if (mount)
      unit = mount->linear();
    else
      leaveOut(options_.level + ": how it is mounted, which no transform tells");
  }
  const auto tilt = tilts_.at(stamp, unit);
  if (!tilt && options_.level != "none" && options_.level != "odometry")
    leaveOut(options_.level + ": no attitude of a cloud's time");
  return tilt.value_or(Eigen::Matrix3d::Identity());
}

void LiveReadings::takeImu(std::string_view cdr) {
  std::string why;
  const auto imu = fromCdr<Imu>(cdr, why);
  const std::lock_guard lock(mutex_);
  if (!imu) return leaveOut(options_.level + ": no message: " + why);
  if (imu->orientationCovariance[0] < 0.0 ||  // which says that there is none
      !tilts_.add(stampOf(imu->header), imu->orientation))
    return leaveOut(options_.level + ": no orientation");
  imuFrame_ = imu->header.frame;
}

void LiveReadings::addOdometry(Timestamp stamp, const Pose2& pose,
                               std::vector<std::uint32_t> words) {
  ++taken_["odometry"];
  put({stamp, options_.odometry, std::move(words)}, pose);
  newestOdometry_ = std::max(newestOdometry_.value_or(stamp), stamp);
  arrived_.notify_all();
}

void LiveReadings::takeOdometry(std::string_view cdr) {
  std::string why;
  const auto moved = fromCdr<Odometry>(cdr, why);
  const std::lock_guard lock(mutex_);
  if (!moved) return leaveOut("odometry: no message: " + why);
  if (!moved->childFrame.empty() && moved->childFrame != options_.base)
    otherBase_ = moved->childFrame;
  const Pose2 pose = toPose2(moved->pose);
  const double forward = moved->linear.x;
  const double left = moved->linear.y;
  const double turn = moved->angular.z;
  if (!isPlausible(pose)) return leaveOut("odometry: no number, or beyond 1000 km");
  for (const double velocity : {forward, left, turn})
    if (!(std::abs(velocity) <= kMaxLogVelocity))
      return leaveOut("odometry: a velocity that is no number, or above 100 m/s or rad/s");
  const Timestamp stamp = stampOf(moved->header);
  velocities_.add(stamp, {forward, left, turn});
  if (options_.level == "odometry") tilts_.add(stamp, moved->pose.orientation);
  addOdometry(stamp, pose, OdometryData::encode({pose, forward, turn, {}, left}));
}

void LiveReadings::takeTransforms(std::string_view cdr, bool isStatic) {
  std::string why;
  const auto all = fromCdr<TfMessage>(cdr, why);
  const std::lock_guard lock(mutex_);
  if (!all) return leaveOut("transforms: no message: " + why);
  for (const TransformStamped& one : all->transforms) {
    const Pose2 pose = toPose2(one.transform);
    // What moves is of no use but for odometry, and anybody may send frames without end.
    const bool isOdometry = one.header.frame == options_.odom && one.childFrame == options_.base;
    if (!isStatic && !isOdometry) continue;
    if (frames_.size() >= kMostWaiting && !frames_.hasFrame(one.childFrame)) {
      leaveOut("transforms: too many frames");
      continue;
    }
    if (!frames_.add(one, isStatic) || !isPlausible(pose)) {
      leaveOut("transforms: no number, or beyond 1000 km");
      continue;
    }
    if (!isOdometry || !options_.followsFrames) continue;
    const Timestamp stamp = stampOf(one.header);
    if (newestOdometry_ && stamp <= *newestOdometry_) {
      leaveOut("transforms: odometry that is not newer");
      continue;
    }
    velocities_.addPose(stamp, pose);
    if (options_.level == "odometry") tilts_.add(stamp, one.transform.orientation);
    addOdometry(stamp, pose, followed_.words(stamp, pose));
  }
}

/// Whether the first moment is complete: scans up to it have odometry of their time, and no other
/// one has yet to come.
bool LiveReadings::isReady(Clock::time_point now) const {
  if (waiting_.empty()) return false;
  const auto& [stamp, first] = *waiting_.begin();
  const bool isCovered =
      newestScan_ && newestOdometry_ && stamp <= std::min(*newestScan_, *newestOdometry_);
  return (isCovered && !streams_.isAwaited(stamp, now)) || now - first.since >= options_.patience;
}

/// Where the robot is in odometry between the last pose that was given and the next that waits.
std::optional<Pose2> LiveReadings::interpolated(Timestamp stamp) const {
  const auto after = std::find_if(waiting_.begin(), waiting_.end(), [](const auto& one) {
    return one.second.inOdometry.has_value();
  });
  if (!lastPose_ || after == waiting_.end() || lastPose_->first >= after->first)
    return std::nullopt;
  const auto& [begin, from] = *lastPose_;
  const Pose2& to = *after->second.inOdometry;
  const double share =
      static_cast<double>(stamp - begin) / static_cast<double>(after->first - begin);
  return Pose2{from.x + share * (to.x - from.x), from.y + share * (to.y - from.y),
               wrapAngle(from.theta + share * wrapAngle(to.theta - from.theta))};
}

std::optional<LiveReadings::Moment> LiveReadings::next(std::chrono::milliseconds longest) {
  std::unique_lock lock(mutex_);
  const Clock::time_point end = Clock::now() + longest;
  while (!isStopped_) {
    const Clock::time_point now = Clock::now();
    if (isReady(now)) {
      auto first = waiting_.extract(waiting_.begin());
      delivered_ = first.key();
      Moment moment{std::move(first.mapped().readings), first.mapped().inOdometry};
      if (moment.inOdometry) lastPose_.emplace(first.key(), *moment.inOdometry);
      if (!moment.inOdometry) moment.inOdometry = interpolated(first.key());
      return moment;
    }
    if (now >= end) return Moment{};
    Clock::time_point until = end;
    if (!waiting_.empty())
      until = std::min(until, waiting_.begin()->second.since + options_.patience);
    arrived_.wait_until(lock, until);
  }
  return std::nullopt;
}

void LiveReadings::stop() {
  const std::lock_guard lock(mutex_);
  isStopped_ = true;
  arrived_.notify_all();
}

std::optional<Timestamp> LiveReadings::newestOdometry() const {
  const std::lock_guard lock(mutex_);
  return newestOdometry_;
}

std::map<std::string, std::uint64_t> LiveReadings::taken() const {
  const std::lock_guard lock(mutex_);
  return taken_;
}

std::string LiveReadings::otherBase() const {
  const std::lock_guard lock(mutex_);
  return otherBase_;
}

std::map<std::string, std::uint64_t> LiveReadings::leftOut() const {
  const std::lock_guard lock(mutex_);
  return leftOut_;
}

}  // namespace ortung::ros2
