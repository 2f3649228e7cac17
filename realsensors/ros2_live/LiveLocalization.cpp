#include "LiveLocalization.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <sstream>
#include <stdexcept>

#include "ReadingMessages.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/formats/FormatNames.hpp"
#include "ortung/formats/OdometryData.hpp"
#include "ortung/formats/ProtectionData.hpp"
#include "ortung/formats/ScanData.hpp"
#include "ortung/formats/TrackData.hpp"
#include "ortung/ros2/Messages.hpp"
#include "ortung/ros2/RobotTopics.hpp"

namespace ortung::ros2 {
namespace {

constexpr std::chrono::milliseconds kLook{20};  ///< between looks at odometry that moves nothing

std::int64_t nanoseconds(Timestamp stamp) { return stamp * 1000; }

std::string placeText(const Pose2& pose) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(2) << pose.x << ", " << pose.y << " m, "
       << std::setprecision(0) << pose.theta / kDegree << " degrees";
  return text.str();
}

const SensorData* onlyOf(const SensorContainer& container, std::string_view format,
                         const std::string& what) {
  const SensorData* found = nullptr;
  for (const auto& data : container.all()) {
    if (data->format().name() != format) continue;
    if (found != nullptr)
      throw std::invalid_argument(what + ": the robot has " + toText(found->id()) + " and " +
                                  toText(data->id()) + ", expected TOPIC=MODEL/TYPE/FEATURE");
    found = data.get();
  }
  if (found == nullptr)
    throw std::invalid_argument(what + ": the robot file has no feature of the format " +
                                std::string(format));
  return found;
}

/// Finds the scanner of TOPIC or TOPIC=MODEL/TYPE/FEATURE. @throws std::invalid_argument
const SensorData& scannerOf(const SensorContainer& container, const std::string& text) {
  const std::size_t equals = text.find('=');
  const SensorData* data = equals == text.npos
                               ? onlyOf(container, formats::kScan, text)
                               : container.findExactly(parseSensorId(text.substr(equals + 1)));
  if (data == nullptr || data->format().name() != formats::kScan)
    throw std::invalid_argument(text + ": the robot file has no scanner of that name");
  return *data;
}

/// Returns the lidar that fills a scanner, which has to see all around as those do that are made of
/// clouds.
LiveReadings::Lidar lidarOf(const SensorContainer& container, const std::string& text,
                            const CloudBands& bands) {
  const SensorData& data = scannerOf(container, text);
  const ScanData::Config config = ScanData::configOf(data.format());
  LiveReadings::Lidar lidar{topicOf(text), data.id(), bands.of(topicOf(text))};
  lidar.band.beams = config.beams;
  lidar.band.maxRange = config.maxRange;
  lidar.band.minRange = std::min(lidar.band.minRange, config.maxRange / 2);
  constexpr double kRounded = 1e-6;  // [rad], of degrees in a file
  if (std::abs(config.firstAngle + kTurn / 2) > kRounded ||
      std::abs(config.angleStep * config.beams - kTurn) > kRounded * config.beams)
    throw std::invalid_argument(text + ": " + toText(data.id()) +
                                " does not see all around, expected beams from -180 degrees on, "
                                "as those of a scanner that is made of clouds");
  return lidar;
}

}  // namespace

LiveReadings::Options LiveLocalization::readingsOf(const Options& options,
                                                   const SensorContainer& container,
                                                   const LiveFloors& floors) {
  LiveReadings::Options wanted;
  wanted.base = options.base;
  wanted.odom = options.odom;
  wanted.followsFrames = options.odometry == "tf";
  wanted.odometry = onlyOf(container, formats::kOdometry, options.odometry)->id();
  for (const std::string& scan : options.scans) {
    const SensorData& data = scannerOf(container, scan);
    const ScanData::Config config = ScanData::configOf(data.format());
    wanted.scanners.push_back(
        {topicOf(scan), data.id(), static_cast<std::size_t>(config.beams), config.maxRange});
  }
  for (const std::string& cloud : options.clouds)
    wanted.lidars.push_back(lidarOf(container, cloud, options.bands));
  wanted.level = options.level;
  for (const std::string& feature : options.features)
    wanted.features.push_back(
        liveFeatureOf(container, feature, options.map,
                      [&floors](const Pose2& pose) { return floors.toField(pose); }));
  return wanted;
}

LiveLocalization::LiveLocalization(const Options& options, LiveRequests& requests)
    : options_(options),
      localization_(std::make_unique<Localization>(options.localization)),
      odometry_(onlyOf(localization_->container(), formats::kOdometry, options.odometry)->id()),
      readings_(readingsOf(options, localization_->container(), floors_)),
      transform_({options.map, options.odom, options.transformTolerance}),
      requests_(requests),
      tellsTransform_(options.tellsTransform),
      likelihood_(options.map) {
  localization_->wantSamples(true);
  floors_.enter(localization_->robot().tables.region.building);
  setActive(true);
  if (options.belief.empty() || options.startsAnew || !std::filesystem::exists(options.belief))
    return;
  try {
    localization_->restoreBelief(options.belief);
  } catch (const TableError& error) {  // of another map, as a rule; the robot can be found anew
    std::cerr << "ortung-ros2: " << error.what() << "; the robot is searched for" << '\n';
  }
}

/// Saves the belief, if it is kept. A full disk does not stop a robot.
void LiveLocalization::saveBelief() {
  if (options_.belief.empty() || !transform_.isKnown()) return;
  try {
    localization_->saveBelief(options_.belief);
  } catch (const TableError& error) {
    std::cerr << "ortung-ros2: " << error.what() << '\n';
  }
}

std::unique_ptr<Localization> LiveLocalization::open(const std::filesystem::path& tables) const {
  LocalizationConfig config = options_.localization;
  config.tables = tables;
  auto opened = std::make_unique<Localization>(config);
  opened->wantSamples(true);
  return opened;
}

void LiveLocalization::changeTables(std::unique_ptr<Localization> opened,
                                    const std::filesystem::path& tables, const std::string& floor) {
  const auto here = lastOdometry_ ? localization_->estimate(lastOdometry_->stamp) : std::nullopt;
  const Building& building = opened->robot().tables.region.building;
  const auto there = here ? floors_.carried(here->pose, building, floor) : std::nullopt;
  // Maps of one building have one frame, as a rule; if not, readings will show it.
  if (there && here->status != TrackStatus::kLost) {
    try {
      opened->take(std::span(&*lastOdometry_, 1));  // from which odometry goes on
      opened->followOdometry();
      opened->setPose(*there, here->covariance);
    } catch (const std::invalid_argument&) {
      std::cerr << "ortung-ros2: the new map has no room where the robot is; it is searched for"
                << '\n';
    }
  }
  floors_.enter(building, floor);
  seeker_.seek(floor);
  options_.localization.tables = tables;
  localization_ = std::move(opened);
  relocalizations_.beginFilter();
  toldStatus_ = 0;
}

void LiveLocalization::setActive(bool isActive) {
  isActive_ = isActive;
  transform_.setTold(isActive && tellsTransform_);
}

void LiveLocalization::change(double transformTolerance, bool tellsTransform, double saveSeconds) {
  tellsTransform_ = tellsTransform;
  options_.saveSeconds = saveSeconds;
  transform_.setAhead(transformTolerance);
  setActive(isActive_);
}

void LiveLocalization::listen(Participant& node) {
  node_ = &node;
  transform_.sendBy(node.publish("/tf", TfMessage::kType, Qos::kDefault));
  pose_ = node.publish("amcl_pose", PoseWithCovarianceStamped::kType, Qos::kLatched);
  particles_ = node.publish("particle_cloud", ParticleCloud::kType, Qos::kSensor);
  diagnostics_ = node.publish("/diagnostics", DiagnosticArray::kType, Qos::kDefault);
  node.subscribe("/tf_static", TfMessage::kType, Qos::kLatched,
                 [this](std::string_view cdr) { readings_.takeTransforms(cdr, true); });
  node.subscribe("/tf", TfMessage::kType, Qos::kDefault, [this](std::string_view cdr) {
    readings_.takeTransforms(cdr, false);
    if (options_.odometry == "tf") followOdometry();
  });
  if (options_.odometry != "tf")
    node.subscribe(options_.odometry, Odometry::kType, Qos::kSensor, [this](std::string_view cdr) {
      readings_.takeOdometry(cdr);
      followOdometry();
    });
  for (std::size_t i = 0; i < options_.scans.size(); ++i)
    node.subscribe(topicOf(options_.scans[i]), LaserScan::kType, Qos::kSensor,
                   [this, i](std::string_view cdr) { readings_.takeScan(i, cdr); });
  likelihood_.connect(node);
  listenForClouds(node);
  const auto& features = readings_.features();
  for (std::size_t i = 0; i < features.size(); ++i)
    node.subscribe(features[i].topic, features[i].type, Qos::kSensor,
                   [this, i](std::string_view cdr) { readings_.takeFeature(i, cdr); });
}

void LiveLocalization::listenForClouds(Participant& node) {
  for (std::size_t i = 0; i < options_.clouds.size(); ++i)
    node.subscribe(topicOf(options_.clouds[i]), PointCloud::kType, Qos::kSensor,
                   [this, i](std::string_view cdr) { readings_.takeCloud(i, cdr); });
  if (!options_.clouds.empty() && options_.level != "odometry" && options_.level != "none")
    node.subscribe(options_.level, Imu::kType, Qos::kSensor,
                   [this](std::string_view cdr) { readings_.takeImu(cdr); });
}

void LiveLocalization::startAt(const LiveRequests::InitialPose& wanted) {
  try {
    localization_->setPose(floors_.toField(wanted.pose), wanted.covariance);
  } catch (const std::exception& error) {
    std::cerr << "ortung-ros2: initial pose: " << error.what() << '\n';
  }
}

/// Does what others have asked for.
void LiveLocalization::obey() {
  const LiveRequests::Asked asked = requests_.take();
  if (asked.isConfigured && options_.startsAnew) localization_->start(options_.localization.start);
  if (asked.relocalizes) localization_->relocalize();
  if (asked.floor)
    seeker_.goTo(*asked.floor, *localization_, lastOdometry_, options_.localization.start);
  if (asked.pose) startAt(*asked.pose);
  if (!asked.tellsNow || !lastOdometry_) return;
  if (const auto here = localization_->estimate(lastOdometry_->stamp)) tellPose(*here);
}

void LiveLocalization::tellPose(const PoseEstimate& estimate) {
  if (!isActive_ || !floors_.isHere(estimate.pose)) return;
  const Header header{nanoseconds(estimate.stamp), options_.map};
  pose_(toCdr(PoseWithCovarianceStamped{header, fromPose2(floors_.fromField(estimate.pose)),
                                        fromPlane(estimate.covariance)}));
  if (const auto cloud = particlesOn(floors_.frame(), localization_->container(), header))
    particles_(toCdr(*cloud));
}

/// Tells how far the localization can be relied on, whenever that changes or was weighed anew.
/// @param relocalized estimate that was put elsewhere, which is told in any case; or null
void LiveLocalization::tellDiagnostics(const PoseEstimate* relocalized) {
  const SensorContainer& container = localization_->container();
  const SensorData* track = container.findExactly({"mcl", "LOCALIZATION", "status"});
  const SensorData* bound = container.findExactly({"mcl", "LOCALIZATION", "protection"});
  if (track == nullptr || bound == nullptr || !isActive_) return;
  const bool isNew = track->sequence() != toldStatus_;
  if (!isNew && relocalized == nullptr) return;
  toldStatus_ = track->sequence();
  TrackData::Reading reading = static_cast<const TrackData*>(track)->reading();
  ProtectionData::Reading protection = static_cast<const ProtectionData*>(bound)->reading();
  Timestamp stamp = track->stamp();
  if (!isNew) {
    stamp = relocalized->stamp;
    reading = {relocalized->status, relocalized->reason, relocalized->quality, relocalized->share};
    protection = {relocalized->protection.metres, relocalized->protection.radians};
  }
  reading.relocalizations = relocalizations_.count();
  reading.relocalization = relocalizations_.cause();
  sayStatus(reading.status, stamp);
  DiagnosticArray told =
      diagnosticsMessage(reading, protection, options_.name, {nanoseconds(stamp), ""});
  floors_.describe(told.status.front());
  diagnostics_(toCdr(told));
}

/// On a thread of DDS, which does not wait for the filter.
void LiveLocalization::followOdometry() {
  if (const auto newest = readings_.newestOdometry()) transform_.follow(*newest);
}

void LiveLocalization::onMoment(const LiveReadings::Moment& moment) {
  if (moment.readings.empty()) return;
  try {
    localization_->take(moment.readings);
  } catch (const std::invalid_argument& error) {
    std::cerr << "ortung-ros2: " << error.what() << '\n';
    return;
  }
  const auto estimate = localization_->update();
  if (estimate) {
    seeker_.onEstimate(*localization_);
    floors_.follow(*estimate, localization_->mcl().floorShares());
    tellFloor();
    tellPose(*estimate);
    if (isActive_) likelihood_.tell(localization_->robot(), estimate->pose.theta, floors_.frame());
  }
  for (const Message& reading : moment.readings)
    if (moment.inOdometry && reading.id == odometry_) lastOdometry_ = reading;
  const Timestamp stamp = moment.readings.front().stamp;
  const auto here = moment.inOdometry ? localization_->estimate(stamp) : std::nullopt;
  std::optional<RelocalizationCount::Placed> placed;
  // Who drives by it is better off with the place of before than with a guess.
  if (here && here->status != TrackStatus::kLost && floors_.isHere(here->pose)) {
    const Pose2& pose = floors_.isHere(here->smooth) ? here->smooth : here->pose;
    placed = {floors_.fromField(pose) * inverse(*moment.inOdometry), *moment.inOdometry};
  }
  const auto& filter = here ? here : estimate;
  const bool isRelocalized = filter && relocalizations_.follow(*filter, placed);
  if (isRelocalized) sayRelocalization(filter->pose);
  // It is told before the transform steps.
  tellDiagnostics(isRelocalized ? &*filter : nullptr);
  if (placed) transform_.correct(placed->odomInMap);
}

/// Tells on the terminal when the robot was found, and when it is lost.
void LiveLocalization::sayStatus(TrackStatus status, Timestamp stamp) {
  const bool isLost = status == TrackStatus::kLost;
  if (isFound_ ? !isLost : status != TrackStatus::kTracking) return;
  // A place that was told is not weighed yet.
  const auto present = isLost ? std::nullopt : localization_->estimate(stamp);
  const Pose2 inField = present ? present->pose : localization_->mcl().estimate().pose;
  if (!floors_.isHere(inField)) return;  // of no map that anybody has
  isFound_ = !isLost;
  std::cout << "ortung-ros2: the robot is " << (isLost ? "lost, last" : "found") << " at "
            << placeText(floors_.fromField(inField)) << '\n'
            << std::flush;
}

/// Tells on the terminal that the robot was put elsewhere in the map, and why. What readings
/// correct is ordinary where odometry is poor, and told in diagnostics alone.
void LiveLocalization::sayRelocalization(const Pose2& inField) const {
  if (relocalizations_.cause() == Relocalization::kReadings) return;
  std::cout << "ortung-ros2: relocalization " << relocalizations_.count();
  if (floors_.isHere(inField)) std::cout << " to " << placeText(floors_.fromField(inField));
  std::cout << ": " << nameOf(relocalizations_.cause()) << '\n' << std::flush;
}

/// Names the topics at which nothing has come since the last report, once each time.
void LiveLocalization::reportSilence() {
  std::vector<std::string> topics = {"odometry"};
  for (const auto* const list : {&options_.scans, &options_.clouds, &options_.features})
    for (const std::string& text : *list) topics.push_back(topicOf(text));
  const auto taken = readings_.taken();
  for (const std::string& topic : topics) {
    const auto found = taken.find(topic);
    const std::uint64_t count = found == taken.end() ? 0 : found->second;
    const bool isSilent = count == counts_[topic];
    counts_[topic] = count;
    if (isSilent && !isSilent_[topic]) {
      const bool isFrame = topic == "odometry" && options_.odometry == "tf";
      const std::string& name = topic == "odometry" ? options_.odometry : topic;
      std::cerr << "ortung-ros2: nothing comes "
                << (isFrame ? "as the transform " + options_.odom + " -> " + options_.base
                            : "at " + (node_ != nullptr ? node_->wholeName(name) : name))
                << '\n';
    }
    isSilent_[topic] = isSilent;
  }
  if (const std::string other = readings_.otherBase(); !other.empty() && !hasToldBase_) {
    hasToldBase_ = true;
    std::cerr << "ortung-ros2: odometry is of the frame " << other << ", not of " << options_.base
              << " (--base-frame?)" << '\n';
  }
}

void LiveLocalization::report() {
  auto wrong = readings_.leftOut();
  if (node_ != nullptr) {
    wrong["messages that were not sent"] = node_->dropped();
    wrong["messages that could not be taken"] = node_->refused();
  }
  for (const auto& [what, count] : wrong) {
    std::uint64_t& told = reported_[what];
    if (told != count)
      std::cerr << "ortung-ros2: left out " << count - told << " times: " << what << '\n';
    told = count;
  }
}

void LiveLocalization::run(const std::function<bool()>& goOn) {
  using Clock = std::chrono::steady_clock;
  using Seconds = std::chrono::duration<double>;
  Clock::time_point reported = Clock::now();
  Clock::time_point saved = reported;
  while (goOn()) {
    obey();
    tellFloor();
    if (const auto moment = readings_.next(kLook)) onMoment(*moment);
    const Clock::time_point now = Clock::now();
    if (Seconds(now - reported).count() >= options_.reportSeconds) {
      reported = now;
      report();
      reportSilence();
    }
    if (Seconds(now - saved).count() >= options_.saveSeconds) {
      saved = now;
      saveBelief();
    }
  }
  likelihood_.finish();
  report();
  saveBelief();
}

}  // namespace ortung::ros2
