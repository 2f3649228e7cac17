#include "RawlogMaker.hpp"

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationBearingRange.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRange.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "ortung/core/ReadingLine.hpp"
#include "ortung/formats/LandmarksData.hpp"
#include "ortung/formats/OdometryData.hpp"
#include "ortung/formats/Words.hpp"

namespace ortung {
namespace {

using namespace mrpt::obs;
using Words = std::vector<std::uint32_t>;

/// Converts a stamp. MRPT counts steps of 100 ns from the year 1601 on.
mrpt::system::TTimeStamp timeOf(Timestamp stamp) {
  constexpr std::int64_t kSteps = 10;  // a microsecond
  constexpr std::int64_t kFrom1601 = 116'444'736'000'000'000;
  constexpr std::int64_t kMost = (std::numeric_limits<std::int64_t>::max() - kFrom1601) / kSteps;
  if (stamp <= -kFrom1601 / kSteps || stamp > kMost)
    throw std::runtime_error("the time " + std::to_string(stamp) +
                             " us can't be written as MRPT's");
  return mrpt::system::TTimeStamp(mrpt::system::TTimeStamp::duration(stamp * kSteps + kFrom1601));
}

mrpt::poses::CPose3D spatial(const Pose2& pose) { return {pose.x, pose.y, 0, pose.theta, 0, 0}; }

double metres(std::uint32_t word) { return word / 1000.0; }

CObservation::Ptr odometryOf(const Message& message) {
  OdometryData data(message.id);
  data.setData(message.stamp, message.words);
  const OdometryData::Reading& reading = data.reading();
  auto made = CObservationOdometry::Create();
  made->odometry = {reading.pose.x, reading.pose.y, reading.pose.theta};
  made->hasVelocities = true;
  made->velocityLocal = {reading.translationalVelocity, reading.lateralVelocity,
                         reading.rotationalVelocity};
  return made;
}

/// Makes a scan. MRPT's beams lie symmetrically on both sides of the scanner's axis.
CObservation::Ptr scanOf(const Pose2& mount, const double (&numbers)[3], const Words& words) {
  const auto [firstAngle, step, maxRange] = numbers;
  auto made = CObservation2DRangeScan::Create();
  made->aperture = static_cast<float>(step * (static_cast<double>(words.size()) - 1));
  made->rightToLeft = true;
  made->maxRange = static_cast<float>(maxRange);
  made->sensorPose =
      spatial(mount * Pose2{0, 0, firstAngle + 0.5 * static_cast<double>(made->aperture)});
  made->resizeScan(words.size());
  for (std::size_t i = 0; i < words.size(); ++i) {
    made->setScanRange(i, static_cast<float>(metres(words[i])));
    made->setScanRangeValidity(i, words[i] != 0);
  }
  return made;
}

CObservation::Ptr landmarksOf(const Pose2& mount, const double (&numbers)[3], const Words& words) {
  auto made = CObservationBearingRange::Create();
  made->maxSensorDistance = static_cast<float>(numbers[0]);
  made->fieldOfView_yaw = static_cast<float>(numbers[1]);
  made->sensorLocationOnRobot = spatial(mount);
  for (std::size_t i = 0; i + 2 < words.size(); i += 3) {
    CObservationBearingRange::TMeasurement one;
    one.landmarkID = static_cast<std::int32_t>(words[i]);
    one.range = static_cast<float>(metres(words[i + 1]));
    one.yaw = static_cast<float>(words::toAngle(words[i + 2]));
    one.pitch = 0;
    made->sensedData.push_back(one);
  }
  return made;
}

CObservation::Ptr coneOf(const Pose2& mount, const double (&numbers)[3], const Words& words) {
  auto made = CObservationRange::Create();
  made->sensorConeApperture = static_cast<float>(numbers[0]);
  made->maxSensorDistance = static_cast<float>(numbers[1]);
  for (const std::uint32_t word : words) {
    CObservationRange::TMeasurement one;
    one.sensorPose = spatial(mount).asTPose();
    one.sensedDistance = static_cast<float>(metres(word));
    made->sensedData.push_back(one);
  }
  return made;
}

}  // namespace

void RawlogMaker::declare(const std::string& line) {
  std::istringstream words(line);
  std::string mark, name;
  Feature feature;
  words >> mark >> feature.kind >> name;
  const std::map<std::string, int> kinds = {
      {"odometry", 0}, {"scan", 6}, {"landmarks", 5}, {"cone", 5}};
  const auto kind = kinds.find(feature.kind);
  if (kind == kinds.end()) return;
  double numbers[6] = {};
  for (int i = 0; i < kind->second; ++i) {
    if (!(words >> numbers[i]) || !std::isfinite(numbers[i]))
      throw std::runtime_error("found '" + line + "', expected " + std::to_string(kind->second) +
                               " numbers in it");
  }
  feature.mount = {numbers[0], numbers[1], numbers[2]};
  std::copy(numbers + 3, numbers + 6, feature.numbers);
  features_[name] = feature;
}

RawlogMaker::Observation::Ptr RawlogMaker::make(const Feature& feature,
                                                const Message& message) const {
  if (feature.kind == "odometry") return odometryOf(message);
  if (feature.kind == "scan") return scanOf(feature.mount, feature.numbers, message.words);
  if (feature.kind == "cone") return coneOf(feature.mount, feature.numbers, message.words);
  return landmarksOf(feature.mount, feature.numbers, message.words);
}

RawlogMaker::Observation::Ptr RawlogMaker::observationOf(std::string_view line) {
  if (line.starts_with('#')) {
    declare(std::string(line));
    return nullptr;
  }
  std::string why;
  const auto message = parseLine(line, &why);
  if (!message) throw std::runtime_error(why);
  const std::string name = toText(message->id);
  const auto feature = features_.find(name);
  if (feature == features_.end())
    throw std::runtime_error("found a reading of " + name + ", which was not declared");
  Observation::Ptr made = make(feature->second, *message);
  made->timestamp = timeOf(message->stamp);
  made->sensorLabel = name;
  return made;
}

}  // namespace ortung
