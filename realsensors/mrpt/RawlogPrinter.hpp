#pragma once

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationBeaconRanges.h>
#include <mrpt/obs/CObservationBearingRange.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/serialization/CSerializable.h>

#include <cstdint>
#include <cstdio>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>

#include "ortung/base/Pose2.hpp"
#include "ortung/core/Message.hpp"
#include "ortung/realsensors/LogSource.hpp"

namespace ortung {

/// Prints a rawlog as the lines of a record, with comments for what a record cannot hold:
///   # scanner X Y YAW FIRST_ANGLE ANGLE_STEP MAX_RANGE BEAMS
///   # beacons X Y YAW MAX_RANGE          where the receiver of beacons' ranges sits
///   # landmarks X Y YAW MAX_RANGE FOV    where the observer of landmarks sits
///   # skipped COUNT WHAT
///   # end COUNT                          number of readings; a complete output ends with it
class RawlogPrinter {
 public:
  explicit RawlogPrinter(std::FILE* out) : out_(out) {}
  void print(const mrpt::serialization::CSerializable& object);
  void finish();

 private:
  void printFrame(const mrpt::obs::CSensoryFrame& frame);
  void print(const mrpt::obs::CObservation& observation);
  void printScan(const mrpt::obs::CObservation2DRangeScan& scan);
  void printBeacons(const mrpt::obs::CObservationBeaconRanges& beacons);
  void printLandmarks(const mrpt::obs::CObservationBearingRange& landmarks);
  void move(const mrpt::obs::CActionCollection& actions);
  void printOdometry(Timestamp stamp, const Pose2& pose);
  void write(Timestamp stamp, SensorId id, std::span<const std::uint32_t> words);
  void comment(const std::string& text);
  Timestamp stampOf(const mrpt::obs::CObservation& observation);

  std::FILE* out_;
  std::string line_;
  Message message_;
  Pose2 pose_;  ///< sum of the increments so far
  PoseOdometry odometry_;
  bool isChained_ = false;  ///< whether odometry comes as increments
  std::string laser_;       ///< label of the scanner whose scans are printed
  std::size_t beams_ = 0;
  std::set<std::string> told_;  ///< comments that are printed only once
  std::map<std::string, std::size_t> skipped_;
  std::size_t steps_ = 0;          ///< number of frames: the time of a log without stamps
  std::optional<Timestamp> time_;  ///< stamp of observations that have none themselves
  Timestamp shift_ = 0;            ///< offset that makes frames of one stamp differ [us]
  std::size_t readings_ = 0;
};

}  // namespace ortung
