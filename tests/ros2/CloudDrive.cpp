#include "CloudDrive.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include "CloudMaker.hpp"
#include "VelocityHistory.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/formats/OdometryData.hpp"
#include "ortung/formats/PoseData.hpp"
#include "ortung/formats/ScanData.hpp"
#include "ortung/run/Localization.hpp"
#include "ortung/run/OpenSource.hpp"
#include "ortung/sim/TableStore.hpp"

namespace ortung::testing {
namespace {

constexpr double kCeiling = 2.6;             // [m]
constexpr double kAhead = 0.1, kHigh = 0.6;  // of the lidar on the robot [m]
constexpr Timestamp kSweep = 100'000;        // [us]
const SensorId kScan{"lidar", "LRF", "scan"};

/// Two rooms and a corridor with doors below lintels, tables with nothing below their tops, and
/// what stands on the floor and hangs from walls. [x, y, size x, size y, low, high]
constexpr const char* kOffice = R"(0 4 16.2 0.2 0 2.6
0 -4 16.2 0.2 0 2.6
8 0 0.2 8 0 2.6
-8 0 0.2 8 0 2.6
-5 0.8 6 0.15 0 2.6
-1.4 0.8 1.2 0.15 2.0 2.6
3.6 0.8 8.8 0.15 0 2.6
1 2.4 0.15 3.2 0 2.6
-4.5 -1.2 7 0.15 0 2.6
-0.4 -1.2 1.2 0.15 2.0 2.6
4.1 -1.2 7.8 0.15 0 2.6
-2.2 -2.6 0.15 2.8 0 2.6
-6 3 1.6 0.8 0.70 0.74
-6.7 2.7 0.06 0.06 0 0.70
-5.3 2.7 0.06 0.06 0 0.70
-6.7 3.3 0.06 0.06 0 0.70
-5.3 3.3 0.06 0.06 0 0.70
-0.5 3.7 1.2 0.4 0 1.9
-7.7 -0.2 0.4 0.8 0 1.2
5 3.6 2 0.6 0 0.9
7.6 2 0.6 1.4 0 2.1
2 -3.6 1.6 0.6 0 0.75
6.5 -3 1.4 0.8 0.70 0.74
5.9 -3 0.08 0.6 0 0.70
7.1 -3 0.08 0.6 0 0.70
-5 -3.7 1.0 0.5 0 1.5
-7.6 -3 0.6 0.6 0 0.5
4.5 0.6 1.0 0.25 1.3 1.7
0.2 -3.85 0.8 0.1 1.0 1.6
)";

void writeOffice(const std::filesystem::path& file) {
  std::ofstream out(file);
  out << "[world]\nname = \"office\"\nx_m = [-8, 8]\ny_m = [-4, 4]\n[physics]\ncycle_ms = 10\n";
  std::istringstream in(kOffice);
  double x = 0, y = 0, w = 0, h = 0, low = 0, high = 0;
  while (in >> x >> y >> w >> h >> low >> high)
    out << "[[rectangle]]\nkind = \"wall\"\ncenter_m = [" << x << ", " << y << "]\nsize_m = [" << w
        << ", " << h << "]\nz_m = [" << low << ", " << high << "]\n";
}

void writeRobot(const std::filesystem::path& file) {
  std::ofstream(file) << R"([robot]
name = "driver"
radius_m = 0.25
[drive]
max_speed_m_s = 0.8
max_turn_deg_s = 90
body_height_m = 1.0
odometry_distance_sigma_m = 0.02
odometry_heading_sigma_deg = 1.0
odometry_turn_sigma_deg = 4.0
[[sensor]]
plugin = "odometry"
period_s = 0.02
[[sensor]]
plugin = "lrf"
model = "lidar"
type = "LRF"
feature = "scan"
pose = { x_m = 0.1, y_m = 0.0, z_m = 0.6, theta_deg = 0.0 }
period_s = 0.1
beams = 360
first_angle_deg = -180
angle_step_deg = 1
max_range_m = 30
perception = "endpoints"
sigma_m = 0.05
sigma_per_m = 0.0
outliers = 0.2
noise_sigma_m = 0.02
noise_sigma_per_m = 0.0
dropout_share = 0.01
)";
}

double lineTo(double from, double along, double plane) {
  const double way = along == 0.0 ? -1.0 : (plane - from) / along;
  return way > 0.0 ? way : 1e9;
}

}  // namespace

CloudDrive::CloudDrive(const std::filesystem::path& folder, double seconds, std::uint64_t seed)
    : robotFile_(folder / "robot.toml") {
  const std::filesystem::path worldFile = folder / "office.toml";
  writeOffice(worldFile);
  writeRobot(robotFile_);
  world_ = readWorld(worldFile);
  const auto robot = openRobot(robotFile_);
  tables_ = TableStore(worldFile).of(robot->config, robot->container, robot->factory);
  const auto source =
      openSource("sim:" + worldFile.string() + "?duration=" + std::to_string(seconds) +
                     "&seed=" + std::to_string(seed),
                 robotFile_, robot->factory);
  PoseData truth({"reference", "groundTruth", "pose"});
  for (Message message; source->next(message);) {
    if (message.id.type == "groundTruth") {
      truth.setData(message.stamp, message.words);
      truth_.push_back({message.stamp, truth.reading()});
      continue;
    }
    if (moments_.empty() || moments_.back().front().stamp != message.stamp) moments_.emplace_back();
    moments_.back().push_back(message);
  }
  if (truth_.size() < 2) throw std::runtime_error("the simulation has no truth");
}

Pose2 CloudDrive::poseAt(Timestamp stamp) const {
  const auto after = std::lower_bound(truth_.begin(), truth_.end(), stamp,
                                      [](const Truth& a, Timestamp t) { return a.stamp < t; });
  if (after == truth_.end()) return truth_.back().pose;
  if (after == truth_.begin()) return after->pose;
  const Truth& before = *std::prev(after);
  const double share =
      static_cast<double>(stamp - before.stamp) / static_cast<double>(after->stamp - before.stamp);
  const Pose2& a = before.pose;
  const Pose2& b = after->pose;
  return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y),
          a.theta + share * wrapAngle(b.theta - a.theta)};
}

/// Where the robot is in space: it sways about its place on the floor.
Eigen::Isometry3d CloudDrive::robotAt(Timestamp stamp, double tilt) const {
  const Pose2 pose = poseAt(stamp);
  const double t = toSeconds(stamp);
  Eigen::Isometry3d robot = Eigen::Isometry3d::Identity();
  robot.translate(Eigen::Vector3d(pose.x, pose.y, 0.0));
  robot.rotate(Eigen::AngleAxisd(pose.theta, Eigen::Vector3d::UnitZ()) *
               Eigen::AngleAxisd(tilt * std::sin(1.7 * t), Eigen::Vector3d::UnitY()) *
               Eigen::AngleAxisd(tilt * std::sin(2.5 * t + 1.0), Eigen::Vector3d::UnitX()));
  return robot;
}

/// Casts a ray at what stands, and at the floor and the ceiling in closed form.
double CloudDrive::rangeOf(const Eigen::Isometry3d& lidar, const Eigen::Vector3d& direction,
                           double maxRange) const {
  const Eigen::Vector3d from = lidar.translation();
  const Eigen::Vector3d along = lidar.linear() * direction;
  RayFan ray{from.x(), from.y(),
             from.z(), std::atan2(along.y(), along.x()),
             0.0,      std::asin(std::clamp(along.z(), -1.0, 1.0)),
             maxRange};
  float range = 0.0F;
  world_->castFan(ray, 0, {&range, 1});
  return std::min({static_cast<double>(range), lineTo(from.z(), along.z(), 0.0),
                   lineTo(from.z(), along.z(), kCeiling)});
}

/// A sweep that begins at a stamp, column by column, while the robot goes on.
ros2::PointCloud CloudDrive::cloudAt(Timestamp stamp, const Lidar& lidar, const CloudUse& use,
                                     std::uint64_t number) const {
  Eigen::Isometry3d mount = Eigen::Isometry3d::Identity();
  mount.translate(Eigen::Vector3d(kAhead, 0.0, kHigh));
  mount.rotate(Eigen::AngleAxisd(use.mountPitch, Eigen::Vector3d::UnitY()));
  Random random(7, number);
  std::vector<CloudPoint> points;
  for (int column = 0; column < lidar.columns; ++column) {
    const double share = static_cast<double>(column) / lidar.columns;
    const auto after = static_cast<Timestamp>(share * static_cast<double>(kSweep));
    const Eigen::Isometry3d pose = robotAt(stamp + after, use.tilt) * mount;
    const double bearing = kTurn * (0.5 - share);  // clockwise, from behind on
    for (int ring = 0; ring < lidar.rings; ++ring) {
      const double up = radians(lidar.lowest + (lidar.highest - lidar.lowest) * ring /
                                                   std::max(1, lidar.rings - 1));
      const Eigen::Vector3d direction(std::cos(up) * std::cos(bearing),
                                      std::cos(up) * std::sin(bearing), std::sin(up));
      double range = rangeOf(pose, direction, lidar.maxRange);
      const bool isSeen = range < lidar.maxRange && random.uniform() >= 0.01;
      range += lidar.noise * random.gaussian();
      const double nan = std::numeric_limits<double>::quiet_NaN();
      const Eigen::Vector3d p = range * direction;
      points.push_back(isSeen ? CloudPoint{p.x(), p.y(), p.z(), 1e3 * static_cast<double>(after)}
                              : CloudPoint{nan, nan, nan, 1e3 * static_cast<double>(after)});
    }
  }
  CloudForm form;
  form.fields.push_back({"t", 16, CloudForm::Field::kWord, 1});
  form.pointStep = 24;
  return cloudOf(points, form, stamp * 1000);
}

DriveErrors CloudDrive::byScanner() { return localize(moments_); }

/// Roll and pitch as an inertial unit tells them: a little off.
Eigen::Matrix3d CloudDrive::tiltToldAt(Timestamp stamp, const CloudUse& use, Random& random) const {
  if (!use.isLevelled) return Eigen::Matrix3d::Identity();
  const Eigen::AngleAxisd heading(poseAt(stamp).theta, Eigen::Vector3d::UnitZ());
  const double off = radians(0.1);
  return heading.toRotationMatrix().transpose() * robotAt(stamp, use.tilt).linear() *
         Eigen::AngleAxisd(off * random.gaussian(), Eigen::Vector3d::UnitX()) *
         Eigen::AngleAxisd(off * random.gaussian(), Eigen::Vector3d::UnitY());
}

/// Puts the scans of clouds into the places of the scanner's, as if each had arrived when its sweep
/// was over.
DriveErrors CloudDrive::byClouds(const Lidar& lidar, const CloudUse& use) {
  Eigen::Isometry3d mount = Eigen::Isometry3d::Identity();
  mount.translate(Eigen::Vector3d(kAhead, 0.0, kHigh));
  mount.rotate(Eigen::AngleAxisd(use.mountPitch, Eigen::Vector3d::UnitY()));
  ros2::CloudShape shape(ros2::CloudBand(), mount);
  ros2::VelocityHistory velocities;
  OdometryData odometry({"odometry", "odometry", "pose"});
  std::vector<std::vector<Message>> moments = moments_;
  for (const auto& moment : moments) {
    for (const Message& message : moment) {
      if (message.id.type != "odometry" || !use.isMotionUsed) continue;
      odometry.setData(message.stamp, message.words);
      const auto& moved = odometry.reading();
      velocities.add(message.stamp, {moved.translationalVelocity, moved.lateralVelocity,
                                     moved.rotationalVelocity});
    }
  }
  Random random(8);
  std::uint64_t number = 0;
  for (auto& moment : moments) {
    for (Message& message : moment) {
      if (message.id != kScan) continue;
      const auto cloud = cloudAt(message.stamp, lidar, use, ++number);
      std::string why;
      const auto layout = ros2::CloudLayout::of(cloud, why);
      if (!layout) throw std::runtime_error(why);
      const auto motion = motionDuring(
          layout->sweep(), message.stamp,
          [&](Timestamp stamp) { return tiltToldAt(stamp, use, random); }, velocities);
      const auto ranges = shape.fit(*layout, motion, why);
      if (ranges.empty()) throw std::runtime_error(why);
      ScanData::encode(ranges, shape.band().maxRange, message.words);
    }
  }
  return localize(moments);
}

DriveErrors CloudDrive::localize(const std::vector<std::vector<Message>>& moments) {
  LocalizationConfig config;
  config.start = {LocalizationStart::Kind::kPose, truth_.front().pose};
  Localization localization(openRobot(robotFile_, *tables_), nullptr, config);
  std::vector<double> errors;
  for (const auto& moment : moments) {
    localization.take(moment);
    localization.update();
    const Timestamp stamp = moment.front().stamp;
    const bool hasScan = std::any_of(moment.begin(), moment.end(),
                                     [](const Message& one) { return one.id == kScan; });
    if (!hasScan || stamp - moments.front().front().stamp < 3'000'000) continue;
    const auto estimate = localization.estimate(stamp);
    if (!estimate) throw std::runtime_error("there is no estimate");
    errors.push_back(distance(estimate->pose, poseAt(stamp)));
  }
  if (errors.empty()) throw std::runtime_error("there are no scans");
  std::sort(errors.begin(), errors.end());
  return {errors[errors.size() / 2], errors.back(), errors.size()};
}

}  // namespace ortung::testing
