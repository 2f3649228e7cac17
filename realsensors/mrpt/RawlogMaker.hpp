#pragma once

#include <mrpt/obs/CObservation.h>
#include <mrpt/poses/CPose3D.h>

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "ortung/base/Pose2.hpp"
#include "ortung/core/Message.hpp"

namespace ortung {

/// Makes MRPT's observations from readings. Its input are the lines of a record, preceded by a line
/// that describes each feature, where NAME is MODEL/TYPE/FEATURE [m, rad]:
///   # odometry NAME
///   # scan NAME X Y YAW FIRST_ANGLE ANGLE_STEP MAX_RANGE
///   # landmarks NAME X Y YAW MAX_RANGE FIELD_OF_VIEW
///   # cone NAME X Y YAW OPENING_ANGLE MAX_RANGE
/// An observation's label is its feature's name. Not thread-safe.
class RawlogMaker {
 public:
  using Observation = mrpt::obs::CObservation;
  /// @throws std::runtime_error saying what is wrong with the line
  /// @returns the observation; nothing for a line that is not a reading
  Observation::Ptr observationOf(std::string_view line);

 private:
  struct Feature {
    std::string kind;
    Pose2 mount;
    double numbers[3] = {};  ///< numbers that follow the mount
  };
  void declare(const std::string& line);
  Observation::Ptr make(const Feature& feature, const Message& message) const;

  std::map<std::string, Feature> features_;
};

}  // namespace ortung
