#include "RawlogPrinter.hpp"

#include <mrpt/core/Clock.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservationOdometry.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <vector>

#include "ortung/core/ReadingLine.hpp"
#include "ortung/formats/LandmarksData.hpp"
#include "ortung/formats/ScalarData.hpp"
#include "ortung/formats/Words.hpp"
#include "ortung/realsensors/LogFile.hpp"

namespace ortung {
namespace {

constexpr Timestamp kMaxShift = 1000000;  // [us]
constexpr double kMaxSeconds = 1e10;
constexpr std::int32_t kMaxIdentity = 1000000;

std::string numbers(std::initializer_list<double> values) {
  std::string text;
  char buffer[64];
  for (const double value : values) {
    if (!std::isfinite(value)) throw std::runtime_error("found a number that is not finite");
    std::snprintf(buffer, sizeof buffer, " %.9g", value);
    text += buffer;
  }
  return text;
}

Pose2 flat(const mrpt::poses::CPose3D& pose) { return {pose.x(), pose.y(), pose.yaw()}; }
Pose2 flat(const mrpt::poses::CPose2D& pose) { return {pose.x(), pose.y(), pose.phi()}; }

bool isLength(double metres) { return std::isfinite(metres) && metres > 0; }

/// MRPT reads the flag as the byte that the file has, which may be neither 0 nor 1: no bool may be
/// made of that.
bool isRightToLeft(const mrpt::obs::CObservation2DRangeScan& scan) {
  unsigned char byte = 0;
  static_assert(sizeof scan.rightToLeft == sizeof byte);
  std::memcpy(&byte, &scan.rightToLeft, sizeof byte);
  return byte != 0;
}

}  // namespace

void RawlogPrinter::print(const mrpt::serialization::CSerializable& object) {
  if (const auto* actions = dynamic_cast<const mrpt::obs::CActionCollection*>(&object)) {
    move(*actions);
  } else if (const auto* frame = dynamic_cast<const mrpt::obs::CSensoryFrame*>(&object)) {
    printFrame(*frame);
  } else if (const auto* one = dynamic_cast<const mrpt::obs::CObservation*>(&object)) {
    ++steps_;
    print(*one);
  } else {
    ++skipped_[object.GetRuntimeClass()->className];
  }
}

/// A frame belongs to increments of odometry, unless it has odometry of its own. Observations
/// without a stamp get that of the others. Frames of one stamp, by a coarse clock, stay separate.
void RawlogPrinter::printFrame(const mrpt::obs::CSensoryFrame& frame) {
  ++steps_;
  const auto before = time_;
  bool hasOdometry = false;
  shift_ = 0;
  for (const auto& observation : frame) {
    if (!observation) continue;
    if (observation->timestamp != INVALID_TIMESTAMP) time_ = stampOf(*observation);
    if (IS_CLASS(*observation, mrpt::obs::CObservationOdometry)) hasOdometry = true;
  }
  if (before && time_ <= before && *before - *time_ < kMaxShift) {
    shift_ = *before - *time_ + 1;
    *time_ += shift_;
  }
  isChained_ = !hasOdometry;
  for (const auto& observation : frame) {
    if (observation) print(*observation);
  }
}

void RawlogPrinter::finish() {
  for (const auto& [what, count] : skipped_)
    comment("skipped " + std::to_string(count) + " " + what);
  comment("end " + std::to_string(readings_));
  if (std::fflush(out_) != 0) throw std::runtime_error("the output cannot be written");
}

void RawlogPrinter::print(const mrpt::obs::CObservation& observation) {
  using namespace mrpt::obs;
  if (const auto* scan = dynamic_cast<const CObservation2DRangeScan*>(&observation)) {
    printScan(*scan);
  } else if (const auto* beacons = dynamic_cast<const CObservationBeaconRanges*>(&observation)) {
    printBeacons(*beacons);
  } else if (const auto* marks = dynamic_cast<const CObservationBearingRange*>(&observation)) {
    printLandmarks(*marks);
  } else if (const auto* odometry = dynamic_cast<const CObservationOdometry*>(&observation)) {
    printOdometry(stampOf(observation), flat(odometry->odometry));
    return;
  } else {
    ++skipped_[observation.GetRuntimeClass()->className];
    return;
  }
  if (isChained_) printOdometry(stampOf(observation), pose_);
}

void RawlogPrinter::printScan(const mrpt::obs::CObservation2DRangeScan& scan) {
  const std::size_t beams = scan.getScanSize();
  if (beams == 0) {
    ++skipped_["scans without beams"];
    return;
  }
  if (beams_ == 0) {
    laser_ = scan.sensorLabel;
    beams_ = beams;
    const Pose2 mount = flat(scan.sensorPose);
    const double first = -0.5 * static_cast<double>(scan.aperture);  // as MRPT places its beams
    const auto steps = static_cast<double>(std::max<std::size_t>(beams, 2) - 1);
    const double step = scan.aperture / steps;
    comment("scanner" + numbers({mount.x, mount.y, mount.theta, first, step, scan.maxRange}) + " " +
            std::to_string(beams));
  }
  if (beams != beams_ || scan.sensorLabel != laser_) {
    ++skipped_["scans of another scanner"];
    return;
  }
  std::vector<std::uint32_t> ranges(beams, 0);  // 0: no valid measurement
  const bool isFromTheRight = isRightToLeft(scan);
  for (std::size_t i = 0; i < beams; ++i) {
    const std::size_t beam = isFromTheRight ? i : beams - 1 - i;
    const double range = scan.getScanRange(i);
    if (scan.getScanRangeValidity(i) && isLength(range)) ranges[beam] = words::fromMetres(range);
  }
  write(stampOf(scan), {"laser", "LRF", "scan"}, ranges);
}

void RawlogPrinter::printBeacons(const mrpt::obs::CObservationBeaconRanges& beacons) {
  const Timestamp stamp = stampOf(beacons);
  for (const auto& sensed : beacons.sensedData) {
    if (sensed.beaconID < 0 || sensed.beaconID > kMaxIdentity || !isLength(sensed.sensedDistance)) {
      ++skipped_["ranges of unknown beacons, or of 0"];
      continue;
    }
    const auto& place = sensed.sensorLocationOnRobot;
    if (told_.insert("beacons").second) {
      comment("beacons" + numbers({place.x(), place.y(), 0.0, beacons.maxSensorDistance}));
    }
    write(stamp, {"uwb", "landmarks", "beacon" + std::to_string(sensed.beaconID) + "Distance"},
          ScalarData::encode(static_cast<double>(sensed.sensedDistance)));
  }
}

void RawlogPrinter::printLandmarks(const mrpt::obs::CObservationBearingRange& landmarks) {
  LandmarksData::Reading sightings;
  for (const auto& sensed : landmarks.sensedData) {
    const bool isKnown = sensed.landmarkID >= 0 && sensed.landmarkID <= kMaxIdentity;
    if (!isKnown || !isLength(sensed.range) || !std::isfinite(sensed.yaw) ||
        std::abs(sensed.yaw) > 100) {
      ++skipped_["sightings of unknown landmarks"];
      continue;
    }
    sightings.push_back(
        {static_cast<std::uint32_t>(sensed.landmarkID), sensed.range, wrapAngle(sensed.yaw)});
  }
  if (told_.insert("landmarks").second) {
    const Pose2 mount = flat(landmarks.sensorLocationOnRobot);
    comment("landmarks" + numbers({mount.x, mount.y, mount.theta, landmarks.maxSensorDistance,
                                   landmarks.fieldOfView_yaw}));
  }
  write(stampOf(landmarks), {"camera", "landmarks", "posts"}, LandmarksData::encode(sightings));
}

void RawlogPrinter::move(const mrpt::obs::CActionCollection& actions) {
  for (const auto& action : actions) {
    const auto* movement =
        dynamic_cast<const mrpt::obs::CActionRobotMovement2D*>(action.get_ptr().get());
    if (!movement) {
      ++skipped_["actions other than movements in the plane"];
      continue;
    }
    const auto& change = movement->estimationMethod == mrpt::obs::CActionRobotMovement2D::emOdometry
                             ? movement->rawOdometryIncrementReading
                             : movement->poseChange->getMeanVal();
    const Pose2 next = pose_ * flat(change);
    if (isPlausible(next))
      pose_ = next;
    else
      ++skipped_["movements that are no numbers or lead beyond 1000 km"];
  }
}

void RawlogPrinter::printOdometry(Timestamp stamp, const Pose2& pose) {
  if (!isPlausible(pose)) {
    ++skipped_["poses of odometry that are no numbers or beyond 1000 km"];
    return;
  }
  write(stamp, {"odometry", "odometry", "pose"}, odometry_.words(stamp, pose));
}

void RawlogPrinter::write(Timestamp stamp, SensorId id, std::span<const std::uint32_t> words) {
  message_.stamp = stamp;
  message_.id = std::move(id);
  message_.words.assign(words.begin(), words.end());
  line_.clear();
  writeLine(message_, line_);
  line_ += '\n';
  if (std::fwrite(line_.data(), 1, line_.size(), out_) != line_.size()) {
    throw std::runtime_error("the output cannot be written");
  }
  ++readings_;
}

void RawlogPrinter::comment(const std::string& text) { std::fprintf(out_, "# %s\n", text.c_str()); }

/// Returns the stamp. Some simulated logs have none: their frames get stamps a second apart.
Timestamp RawlogPrinter::stampOf(const mrpt::obs::CObservation& observation) {
  if (observation.timestamp == INVALID_TIMESTAMP) {
    return time_.value_or(fromSeconds(static_cast<double>(steps_)));
  }
  const double seconds = mrpt::Clock::toDouble(observation.timestamp);
  if (!(std::abs(seconds) < kMaxSeconds))
    throw std::runtime_error("found an impossible time stamp");
  return fromSeconds(seconds) + shift_;
}

}  // namespace ortung
