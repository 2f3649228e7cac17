#pragma once

#include <deque>
#include <limits>
#include <optional>

#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/base/Time.hpp"

namespace ortung {

/// The recent path of odometry: poses between its readings, and a little beyond. Not thread-safe.
class ORTUNG_API OdometryTrack {
 public:
  /// @param kept how much of the past is kept [s]
  explicit OdometryTrack(double kept = std::numeric_limits<double>::infinity());

  /// Takes a reading. If time runs backwards, all before it is forgotten.
  /// @param v,w velocities in force from its stamp on, forwards and turning [m/s], [rad/s]
  /// @param sideways velocity to the left, of a robot that can [m/s]
  void add(Timestamp stamp, const Pose2& pose, double v, double w, double sideways = 0.0);
  void clear() { readings_.clear(); }
  bool empty() const { return readings_.empty(); }
  Timestamp first() const { return readings_.front().stamp; }  ///< oldest stamp; @pre not empty()
  Timestamp last() const { return readings_.back().stamp; }    ///< newest stamp; @pre not empty()

  /// Returns the pose at @p stamp: on the arc between two readings; beyond the first and the last
  /// one, on the arc of its velocities for at most 0.3 s. Nothing if there is no reading.
  std::optional<Pose2> at(Timestamp stamp) const;
  /// Returns the time between the two readings around @p stamp [s]; infinite outside of all.
  double gapAt(Timestamp stamp) const;

 private:
  struct Reading {
    Timestamp stamp;
    Pose2 pose;
    double v;
    double w;
    double sideways;
  };
  std::deque<Reading>::const_iterator behind(Timestamp stamp) const;
  double kept_;
  std::deque<Reading> readings_;
};

}  // namespace ortung
