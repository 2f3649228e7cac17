#include "ReadingMessages.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>
#include <utility>

#include "ortung/base/Angles.hpp"
#include "ortung/camera/ImageData.hpp"
#include "ortung/formats/ChangesData.hpp"
#include "ortung/formats/OdometryData.hpp"
#include "ortung/formats/PoseFixData.hpp"
#include "ortung/formats/Words.hpp"
#include "ortung/ros2/RobotTopics.hpp"

namespace ortung::ros2 {
namespace {

/// Indices of x, y and heading in a covariance of six dimensions.
constexpr std::size_t kPlanar[3] = {0, 1, 5};

float rangeOf(std::uint32_t word, double maxRange) {
  const double range = words::toMetres(word);
  if (word == 0) return std::numeric_limits<float>::quiet_NaN();
  return range >= maxRange ? std::numeric_limits<float>::infinity() : static_cast<float>(range);
}

/// Returns a number for people; "inf" for what is unbounded.
std::string numberText(double number) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.6g", number);
  return text.data();
}

}  // namespace

Pose fromPose2(const Pose2& pose) {
  return {{pose.x, pose.y, 0.0}, {0.0, 0.0, std::sin(pose.theta / 2), std::cos(pose.theta / 2)}};
}

Covariance fromPlane(const PoseCovariance& plane) {
  Covariance space{};
  for (std::size_t i = 0; i < plane.size(); ++i)
    space[kPlanar[i / 3] * 6 + kPlanar[i % 3]] = plane[i];
  return space;
}

PoseCovariance toPlane(const Covariance& space) {
  PoseCovariance plane{};
  for (std::size_t i = 0; i < plane.size(); ++i)
    plane[i] = space[kPlanar[i / 3] * 6 + kPlanar[i % 3]];
  return plane;
}

Pose2 toPose2(const Pose& pose) {
  const Quaternion& q = pose.orientation;
  const double sine = 2.0 * (q.w * q.z + q.x * q.y);
  const double cosine = q.w * q.w + q.x * q.x - q.y * q.y - q.z * q.z;
  const double length = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
  const double theta =
      length > 0.0 ? std::atan2(sine, cosine) : std::numeric_limits<double>::quiet_NaN();
  return {pose.position.x, pose.position.y, theta};
}

std::int64_t rosTime(Timestamp stamp) {
  constexpr Timestamp kEnd = Timestamp{1} << 31;  // [s]
  if (stamp < 0 || stamp / 1'000'000 >= kEnd)
    throw std::invalid_argument("a stamp of " + std::to_string(stamp) +
                                " us, expected one that ROS has: from 0 on, below 2^31 s");
  return stamp * 1000;
}

Odometry odometryMessage(const Message& reading, Header header, std::string child) {
  OdometryData data(reading.id);
  data.setData(reading.stamp, reading.words);
  const OdometryData::Reading& state = data.reading();
  Odometry out;
  out.header = std::move(header);
  out.childFrame = std::move(child);
  out.pose = fromPose2(state.pose);
  out.linear = {state.translationalVelocity, state.lateralVelocity, 0.0};
  out.angular = {0.0, 0.0, state.rotationalVelocity};
  return out;
}

bool hasMotionData(const Message& reading) {
  OdometryData data(reading.id);
  data.setData(reading.stamp, reading.words);
  return !data.reading().motionData.empty();
}

LaserScan scanMessage(const Message& reading, const ScanData::Config& config, Header header) {
  LaserScan out;
  out.header = std::move(header);
  out.angleMin = static_cast<float>(config.firstAngle);
  out.angleMax = static_cast<float>(config.firstAngle + config.angleStep * (config.beams - 1));
  out.angleIncrement = static_cast<float>(config.angleStep);
  out.rangeMin = static_cast<float>(config.minRange);
  out.rangeMax = static_cast<float>(config.maxRange);
  out.ranges.reserve(reading.words.size());
  for (const std::uint32_t word : reading.words)
    out.ranges.push_back(rangeOf(word, config.maxRange));
  return out;
}

Range rangeMessage(const Message& reading, const Format& cone, Header header) {
  Range out;
  out.header = std::move(header);
  const double maxRange = cone.number("max_m");
  out.fieldOfView = static_cast<float>(cone.angle("opening_deg"));
  out.maxRange = static_cast<float>(maxRange);
  out.range = rangeOf(reading.words.at(0), maxRange);
  return out;
}

double metresOf(const Range& told) {
  if (told.range >= told.maxRange && told.maxRange > 0.0F)
    return std::numeric_limits<double>::infinity();
  if (!(told.range > 0.0F) || told.range < told.minRange)
    return std::numeric_limits<double>::quiet_NaN();
  return static_cast<double>(told.range);
}

std::optional<Range> rowRangeMessage(const Message& reading, const Format& row, Header header) {
  for (const WordValue& value : valuesOfRows(row, reading.words)) {
    if (value.kind != ValueKind::kRange) continue;
    Range out;
    out.header = std::move(header);
    out.maxRange = static_cast<float>(value.most);
    out.range = rangeOf(reading.words[value.word], value.most);
    return out;
  }
  return std::nullopt;
}

Image imageMessage(const Message& reading, Header header) {
  ImageData data(reading.id, {});
  data.setData(reading.stamp, reading.words);
  const ImageView view = data.reading();
  Image out;
  out.header = std::move(header);
  out.height = static_cast<std::uint32_t>(view.size.height);
  out.width = static_cast<std::uint32_t>(view.size.width);
  out.encoding = view.format == PixelFormat::kGrey ? "mono8" : "rgb8";
  out.step = out.width * static_cast<std::uint32_t>(view.channels());
  out.data.assign(view.pixels, view.pixels + view.bytes());
  return out;
}

std::optional<PoseWithCovarianceStamped> poseMessage(const Message& reading, Header header) {
  PoseFixData data(reading.id, {});
  data.setData(reading.stamp, reading.words);
  if (data.reading().empty()) return std::nullopt;
  const PoseFixData::Fix& fix = data.reading().front();
  return PoseWithCovarianceStamped{std::move(header), fromPose2(fix.pose),
                                   fromPlane(fix.covariance)};
}

PoseArray samplesMessage(const Message& reading, Header header) {
  constexpr std::size_t kWords = 4;  // a sample: x, y, heading, weight
  if (reading.words.size() % kWords != 0)
    throw std::invalid_argument(toText(reading.id) + ": found " +
                                std::to_string(reading.words.size()) +
                                " words, expected four a sample");
  PoseArray out{std::move(header), {}};
  for (std::size_t i = 0; i < reading.words.size(); i += kWords)
    out.poses.push_back(fromPose2({words::toSignedMetres(reading.words[i]),
                                   words::toSignedMetres(reading.words[i + 1]),
                                   radians(reading.words[i + 2] % words::kAngles / 100.0)}));
  return out;
}

std::optional<OccupancyGrid> changesMessage(const Message& reading, Header header) {
  constexpr double kMostCells = 1U << 22;
  ChangesData data;
  data.setData(reading.stamp, reading.words);
  const ChangesData::Reading changes = data.reading();
  const auto numberOf = [&](double at) { return std::floor(at / changes.cell); };
  double left = std::numeric_limits<double>::infinity();
  double bottom = left;
  double right = -left;
  double top = -left;
  for (const ChangesData::Cell& one : changes.cells) {
    if (!one.isSure) continue;
    left = std::min(left, numberOf(one.x));
    right = std::max(right, numberOf(one.x));
    bottom = std::min(bottom, numberOf(one.y));
    top = std::max(top, numberOf(one.y));
  }
  if (left > right) left = right = bottom = top = 0.0;  // viewers want one cell at least
  const double columns = right - left + 1.0;
  const double rows = top - bottom + 1.0;
  if (columns * rows > kMostCells) return std::nullopt;
  OccupancyGrid out;
  out.header = std::move(header);
  out.mapLoadTime = out.header.stamp;
  out.resolution = static_cast<float>(changes.cell);
  out.width = static_cast<std::uint32_t>(columns);
  out.height = static_cast<std::uint32_t>(rows);
  out.origin = fromPose2({left * changes.cell, bottom * changes.cell, 0.0});
  out.data.assign(static_cast<std::size_t>(columns * rows), std::int8_t{-1});
  for (const ChangesData::Cell& one : changes.cells)
    if (one.isSure)
      out.data[static_cast<std::size_t>((numberOf(one.y) - bottom) * columns + numberOf(one.x) -
                                        left)] = one.isNew ? 100 : 0;
  return out;
}

DiagnosticArray diagnosticsMessage(const TrackData::Reading& track,
                                   const ProtectionData::Reading& bound, const std::string& name,
                                   Header header) {
  using Level = DiagnosticArray::Status::Level;
  constexpr Level kLevels[] = {Level::kOk, Level::kWarn, Level::kError};
  DiagnosticArray::Status status;
  status.level = kLevels[static_cast<std::size_t>(track.status)];
  status.name = name;
  status.message = std::string(nameOf(track.status)) + ": " + nameOf(track.reason);
  status.values = {{"quality", numberText(track.quality)},
                   {"share", numberText(track.share)},
                   {"protection_m", numberText(bound.metres)},
                   {"protection_deg", numberText(degrees(bound.radians))},
                   {"relocalizations", std::to_string(track.relocalizations)},
                   {"relocalization", nameOf(track.relocalization)}};
  return {std::move(header), {std::move(status)}};
}

}  // namespace ortung::ros2
